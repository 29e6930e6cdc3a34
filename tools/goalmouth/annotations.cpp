#include "tools/goalmouth/annotations.h"

#include "core/imaging/image_file.h"
#include "core/process/configuration.h"
#include "core/process/text.h"

#include <algorithm>
#include <cstdio>
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
    image.set = entry.at("set").get<std::string>();
    image.name = entry.at("file").get<std::string>();
    image.file = folder / image.name;
    image.width = entry.value("width", 0);
    image.height = entry.value("height", 0);
    if (entry.contains("posts")) {
        for (const json& post : entry["posts"]) {
            image.posts.push_back(outline(post));
            image.edge_sigmas.emplace_back();
            if (post.contains("u_edge")) image.edge_sigmas.back() = post["u_edge"].get<double>();
        }
    }
    if (entry.contains("ignore")) {
        for (const json& box : entry["ignore"]) {
            const cv::Point upper(box.at(0).get<int>(), box.at(1).get<int>());
            image.ignore.emplace_back(upper, cv::Point(box.at(2).get<int>(), box.at(3).get<int>()));
        }
    }
    return image;
}

}  // namespace

Annotations::Annotations(const std::filesystem::path& file, const std::filesystem::path& folder)
    : file_(file) {
    const std::vector<std::uint8_t> bytes = read_bytes(file);
    try {
        const json root = json::parse(bytes.begin(), bytes.end());
        for (const char* group : {"images", "negatives", "excluded"}) {
            if (!root.is_object() || !root.contains(group)) continue;
            for (const json& entry : root[group]) {
                images_.push_back(annotated_image(entry, folder.empty() ? file.parent_path() : folder));
                images_.back().excluded = std::string(group) == "excluded";
            }
        }
    } catch (const json::exception& error) {
        throw ConfigurationError(file.string() + ": not an annotation file: " + error.what());
    }
    if (images_.empty())
        throw ConfigurationError(file.string() +
                                 ": not an annotation file: there is no picture in `images` or `negatives`");
    std::sort(images_.begin(), images_.end(),
              [](const AnnotatedImage& a, const AnnotatedImage& b) { return a.file < b.file; });
}

std::vector<std::string> Annotations::sets() const {
    std::set<std::string> names;
    for (const AnnotatedImage& image : images_) names.insert(image.set);
    return {names.begin(), names.end()};
}

std::vector<AnnotatedImage> Annotations::pictures(const std::string& set) const {
    std::vector<AnnotatedImage> chosen;
    for (const AnnotatedImage& image : images_)
        if (image.set == set) chosen.push_back(image);
    if (chosen.empty())
        throw ConfigurationError(file_.string() + ": has no set \"" + set + "\"; " + suggestion(set, sets()));
    return chosen;
}

std::vector<AnnotatedImage> Annotations::usable_pictures(const std::string& set) const {
    std::vector<AnnotatedImage> chosen = pictures(set);
    std::erase_if(chosen, [](const AnnotatedImage& image) { return image.excluded; });
    return chosen;
}

LabelledScene load_scene(const AnnotatedImage& annotated) {
    std::optional<ImageSize> size;
    if (annotated.width > 0 && annotated.height > 0) size = ImageSize{annotated.width, annotated.height};
    return {read_image(annotated.file, size), annotated.posts, annotated.ignore};
}

std::optional<Fold> parse_fold(const std::string& text) {
    Fold fold;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%d/%d%c", &fold.index, &fold.count, &rest) != 2) return std::nullopt;
    if (fold.count < 2 || fold.index < 0 || fold.index >= fold.count) return std::nullopt;
    return fold;
}

}  // namespace goalmouth
