#include "core/process/paths.h"
#include "tools/goalmouth/bench_options.h"
#include "tools/goalmouth/verbs.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include <CLI/CLI.hpp>

namespace goalmouth {
namespace {

constexpr const char* program_name = "goalmouth_bench";

int run_program(const BenchOptions& options) {
    check_bench_options(options);
    const std::filesystem::path program = program_folder() / program_name;
    if (::access(program.c_str(), X_OK) != 0)
        throw std::runtime_error("bench: there is no " + program.string() +
                                 ": it is built where Google Benchmark is found (apt install "
                                 "libbenchmark-dev, then build anew)");
    std::vector<std::string> words = bench_arguments(options);
    words.insert(words.begin(), program.string());
    std::vector<char*> argv;
    for (auto& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    ::execv(program.c_str(), argv.data());
    throw std::runtime_error("bench: cannot run " + program.string() + ": " + std::strerror(errno));
}

}  // namespace

void add_bench_verb(CLI::App& app, Action& action) {
    const auto options = std::make_shared<BenchOptions>();
    CLI::App* verb = app.add_subcommand(
        "bench", "Time our stages beside what people would use instead, and the graph of processes");
    add_bench_options(*verb, *options);
    verb->callback([options, &action] { action = [options] { return run_program(*options); }; });
}

}  // namespace goalmouth
