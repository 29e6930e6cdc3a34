// A module that behaves as its parameter says: well, or as badly as a process can.

#include "core/process/run_module.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <unistd.h>

namespace goalmouth {
namespace {

struct HelperParameters {
    std::string behaviour = "well";
    std::string file;
    double after = 0.0;
};

template <class Visitor>
void describe_parameters(Visitor& v, HelperParameters& p) {
    v("behaviour", p.behaviour,
      Choice{"well", "aborts", "exits_1", "finishes", "misconfigured", "stubborn", "has_child",
             "abandons_child", "talks"},
      "what it does");
    v("file", p.file, File{true}, "a file it does nothing with");
    v("after", p.after, Range{0, 100}, "s", "when it does it");
}

class Helper : public Module {
  public:
    using Parameters = HelperParameters;

    static ModuleInfo info() { return {"graph_helper", "Behaves as told.", {}, {}}; }

    Helper(ModuleContext&, const Parameters& parameters)
        : parameters_(parameters), start_(std::chrono::steady_clock::now()) {
        if (parameters_.behaviour == "misconfigured")
            throw ConfigurationError("helper.yaml:3: behaviour: is not valid");
        std::printf("file %s\n", parameters_.file.c_str());
        if (parameters_.behaviour == "stubborn") std::signal(SIGTERM, SIG_IGN);
        if (parameters_.behaviour == "has_child" || parameters_.behaviour == "abandons_child") make_child();
        std::printf("ready\n");
        std::fflush(stdout);
    }

    std::chrono::microseconds tick() override {
        const std::chrono::duration<double> age = std::chrono::steady_clock::now() - start_;
        if (age.count() >= parameters_.after) act();
        return std::chrono::milliseconds(10);
    }

    bool finished() const override { return finished_; }

  private:
    static void make_child() {
        const pid_t child = ::fork();
        if (child == 0) {
            std::signal(SIGTERM, SIG_IGN);
            for (;;) ::pause();
        }
        std::printf("child %d\n", child);
    }

    void act() {
        if (parameters_.behaviour == "aborts") std::abort();
        if (parameters_.behaviour == "exits_1" || parameters_.behaviour == "abandons_child") ::_exit(1);
        if (parameters_.behaviour == "finishes") finished_ = true;
        if (parameters_.behaviour == "talks" && said_++ < 200) {
            // In pieces, as a program without line buffering writes.
            std::printf("this is one ");
            std::fflush(stdout);
            std::printf("whole line\n");
            std::fflush(stdout);
        }
    }

    HelperParameters parameters_;
    std::chrono::steady_clock::time_point start_;
    bool finished_ = false;
    int said_ = 0;
};

}  // namespace
}  // namespace goalmouth

int main(int argc, char** argv) {
    return goalmouth::run_module<goalmouth::Helper>(argc, argv);
}
