#include "tools/goalmouth/colours_annotations.h"

#include "core/imaging/file_error.h"
#include "core/imaging/image_file.h"
#include "core/process/configuration.h"

#include <algorithm>
#include <set>

#include <nlohmann/json.hpp>

namespace goalmouth {

namespace {

using nlohmann::json;

cv::Point2d point(const json& pair) {
    return {pair.at(0).get<double>(), pair.at(1).get<double>()};
}

PostOutline outline(const json& post) {
    return {point(post.at("base_left")), point(post.at("base_right")), point(post.at("top_right")),
            point(post.at("top_left"))};
}

AnnotatedImage annotated_image(const json& entry, const std::filesystem::path& folder) {
    AnnotatedImage image;
    image.file = folder / entry.at("file").get<std::string>();
    image.width = entry.value("width", 0);
    image.height = entry.value("height", 0);
    if (entry.contains("posts"))
        for (const json& post : entry["posts"]) image.posts.push_back(outline(post));
    if (entry.contains("ignore")) {
        for (const json& box : entry["ignore"]) {
            const cv::Point upper(box.at(0).get<int>(), box.at(1).get<int>());
            image.ignore.emplace_back(upper, cv::Point(box.at(2).get<int>(), box.at(3).get<int>()));
        }
    }
    return image;
}

}  // namespace

std::vector<AnnotatedImage> load_annotations(const std::filesystem::path& file, const std::string& set) {
    const std::vector<std::uint8_t> bytes = read_bytes(file);
    std::vector<AnnotatedImage> images;
    std::set<std::string> sets;
    try {
        const json root = json::parse(bytes.begin(), bytes.end());
        for (const char* group : {"images", "negatives", "excluded"}) {
            if (!root.contains(group)) continue;
            for (const json& entry : root[group]) {
                sets.insert(entry.at("set").get<std::string>());
                if (entry.at("set") != set) continue;
                images.push_back(annotated_image(entry, file.parent_path()));
                images.back().excluded = std::string(group) == "excluded";
            }
        }
    } catch (const json::exception& error) {
        throw ConfigurationError(file.string() + ": not an annotation file: " + error.what());
    }
    if (images.empty()) {
        std::string known;
        for (const std::string& name : sets) known += (known.empty() ? "" : ", ") + name;
        throw ConfigurationError(file.string() + ": has no set \"" + set + "\"; it has: " + known);
    }
    std::sort(images.begin(), images.end(),
              [](const AnnotatedImage& a, const AnnotatedImage& b) { return a.file < b.file; });
    return images;
}

LabelledScene load_scene(const AnnotatedImage& annotated) {
    std::optional<ImageSize> size;
    if (annotated.width > 0 && annotated.height > 0) size = ImageSize{annotated.width, annotated.height};
    return {read_image(annotated.file, size), annotated.posts, annotated.ignore};
}

}  // namespace goalmouth
