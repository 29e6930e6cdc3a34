#pragma once

#include "core/process/graph.h"
#include "tests/support/data.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include <gtest/gtest.h>

namespace goalmouth::test {

/// Programs that exist nowhere but here, and what they would answer.
inline bool describe_for_test(const std::string& executable, ProgramDescription& description) {
    static const std::map<std::string, ProgramDescription> programs = {
        {"source",
         {{"source", "makes images", {}, {{"IMAGE", "image_t", "", false}}},
          {{"frames_per_second", "30", "a number", "1/s", ""},
           {"walk.speed", "0.2", "a number", "m/s", ""},
           {"offsets", "[]", "a list of numbers", "m", ""},
           {"field", "f.yaml", "the name of a file", "", ""}}}},
        {"finder",
         {{"finder", "finds posts", {{"IMAGE", "image_t", "", false}}, {{"POSTS", "posts_t", "", false}}},
          {{"threshold", "3", "a number", "px", ""}, {"table", "t.gmct", "the name of a file", "", ""}}}},
        {"other_finder",
         {{"other_finder",
           "finds posts",
           {{"IMAGE", "image_t", "", false}},
           {{"POSTS", "posts_t", "", false}}},
          {}}},
        {"locator",
         {{"locator",
           "finds itself",
           {{"POSTS", "posts_t", "", false}, {"ODOMETRY", "odometry_t", "", true}},
           {{"POSE", "pose_t", "", false}}},
          {{"field", "f.yaml", "the name of a file", "", ""}}}},
        {"odd", {{"odd", "reads posts as poses", {{"POSTS", "pose_t", "", false}}, {}}, {}}},
        {"tap",
         {{"tap", "records", {{"IMAGE", "image_t", "", false}}, {{"IMAGE_TAP", "image_t", "", false}}},
          {{"every", "15", "a number", "1", ""}, {"encoding", "jpeg", "one of: raw, jpeg", "", ""}}}},
    };
    const auto found = programs.find(executable);
    if (found == programs.end()) return false;
    description = found->second;
    return true;
}

inline constexpr const char* good_graph = R"(seed: 7
lcm_url: udpm://239.255.76.67:7667?ttl=0
common:
  field: fields/small.yaml
processes:
  - name: camera
    executable: source
    parameters: {frames_per_second: 15, walk: {speed: 0.1}}
  - name: detection
    executable: finder
  - name: localisation
    executable: locator
)";

class GraphFileTest : public testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        const auto file = folder_.path() / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << text;
        return file;
    }

    static Graph load(const std::filesystem::path& file, GraphOptions options = {}) {
        options.describe = describe_for_test;
        return load_graph(file.string(), options);
    }

    Graph load_text(const std::string& text, GraphOptions options = {}) const {
        return load(write("graph.yaml", text), std::move(options));
    }

    /// The error that the text is answered with, its folder left out.
    std::string error_of(const std::string& text, GraphOptions options = {}) const {
        try {
            load_text(text, std::move(options));
        } catch (const ConfigurationError& error) {
            std::string what = error.what();
            const std::string folder = folder_.path().string() + "/";
            for (auto at = what.find(folder); at != std::string::npos; at = what.find(folder))
                what.erase(at, folder.size());
            return what;
        }
        return "no error";
    }

    /// The good graph with one text replaced by another.
    static std::string with(const std::string& old_text, const std::string& new_text) {
        std::string text = good_graph;
        const auto at = text.find(old_text);
        if (at == std::string::npos) throw std::logic_error("the good graph holds no " + old_text);
        return text.replace(at, old_text.size(), new_text);
    }

    test::TemporaryFolder folder_;
};

}  // namespace goalmouth::test
