#include "core/imaging/file_error.h"
#include "core/process/configuration.h"
#include "tests/bench/bench.h"
#include "tools/goalmouth/bench_options.h"

#include <exception>
#include <iostream>

#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
    CLI::App app{"Times goalmouth's stages beside what people would use instead, and the graph of processes.",
                 "goalmouth bench"};
    goalmouth::BenchOptions options;
    goalmouth::add_bench_options(app, options);
    try {
        app.parse(argc, argv);
        return goalmouth::bench::run_bench(options);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const goalmouth::ConfigurationError& error) {
        std::cerr << "goalmouth: " << error.what() << '\n';
        return 2;
    } catch (const goalmouth::FileError& error) {
        std::cerr << "goalmouth: " << error.what() << '\n';
        return 2;
    } catch (const std::exception& error) {
        std::cerr << "goalmouth: " << error.what() << '\n';
        return 1;
    }
}
