#include "core/imaging/image_file.h"
#include "tests/support/data.h"
#include "tests/tools_detect/annotations.h"
#include "tests/tools_detect/failure_sheet.h"
#include "tools/goalmouth/colours_train.h"
#include "tools/goalmouth/image_chain.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

// How many posts of the annotated real pictures are found, and how many that are none. Colour tables are
// trained in four folds: the table a picture is judged with never saw it. What failed is drawn into
// real_images/ of the build folder.
namespace goalmouth {
namespace {

using namespace goalmouth::test;

constexpr int folds = 4;

/// The pictures of a set, by name: the order that folds count in.
std::vector<AnnotatedImage> pictures_of(const std::filesystem::path& data, const std::string& set) {
    std::vector<AnnotatedImage> all = read_annotations(data / "annotations.json");
    std::erase_if(all, [&](const AnnotatedImage& a) { return a.set != set; });
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
    return all;
}

Score evaluate(const std::filesystem::path& data, const std::filesystem::path& tables, const std::string& set,
               const std::string& detector) {
    const TemporaryFolder folder;
    const auto config = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config" / "modules";
    std::vector<std::unique_ptr<ImageChain>> chains;
    for (int fold = 0; fold < folds; ++fold) {
        ImageChainOptions options;
        const auto graph = folder.path() / "graph.yaml";
        std::FILE* out = std::fopen(graph.c_str(), "w");
        std::fprintf(
            out,
            "seed: 1\nexternal: [IMAGE]\nprocesses:\n  - {name: segmentation, executable: segmentation}\n"
            "  - {name: extraction, executable: extraction}\n  - {name: detection, executable: %s, config: "
            "%s}\n",
            detector == "detection_histogram" ? "detection_histogram" : "detection_ransac",
            (config / (detector + ".yaml")).c_str());
        std::fclose(out);
        options.graph = graph.string();
        options.colours = tables / (set + std::to_string(fold) + ".gmct");
        chains.push_back(std::make_unique<ImageChain>(options));
    }
    Score sum;
    FailureSheet failures;
    const auto pictures = pictures_of(data, set);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const YuyvImage image = read_image(data / pictures[i].file);
        const ImageResult result = chains[i % folds]->run({.image = image.view(), .camera = {}});
        const Score one = score(pictures[i], result.posts);
        failures.add(pictures[i], image.view(), result, one);
        if (one.missed + one.wrong > 0) {
            std::printf("    %s: %d found, %d missed, %d wrong\n", pictures[i].file.c_str(), one.found,
                        one.missed, one.wrong);
        }
        sum += one;
    }
    std::printf("%s, %s: %d found, %d missed, %d wrong: recall %.1f %%, precision %.1f %%\n", set.c_str(),
                detector.c_str(), sum.found, sum.missed, sum.wrong, 100.0 * sum.recall(),
                100.0 * sum.precision());
    failures.write(std::filesystem::path(GOALMOUTH_BINARY_DIR) / "real_images" /
                   (set + "-" + detector + ".png"));
    return sum;
}

void train(const std::filesystem::path& data, const std::filesystem::path& folder, const std::string& set) {
    for (int fold = 0; fold < folds; ++fold) {
        TrainColoursOptions options;
        options.annotations = data / "annotations.json";
        options.set = set;
        options.fold = Fold{fold, folds};
        options.output = folder / (set + std::to_string(fold) + ".gmct");
        ASSERT_EQ(train_colours(options), 0);
    }
}

void expect_at_least(const Score& score, double recall, double precision) {
    EXPECT_GE(score.recall(), recall);
    EXPECT_GE(score.precision(), precision);
}

// Bounds: what was measured, less one post.

TEST(RealImages, DarwinOp2014) {
    GOALMOUTH_NEEDS_DATA(data);
    const TemporaryFolder tables;
    train(data, tables.path(), "darwin_op_2014");
    expect_at_least(evaluate(data, tables.path(), "darwin_op_2014", "detection_ransac"), 0.86, 0.86);
    expect_at_least(evaluate(data, tables.path(), "darwin_op_2014", "detection_ransac_tuned"), 0.93, 0.93);
    evaluate(data, tables.path(), "darwin_op_2014", "detection_histogram");
}

TEST(RealImages, NaoUva2013) {
    GOALMOUTH_NEEDS_DATA(data);
    const TemporaryFolder tables;
    train(data, tables.path(), "nao_uva_2013");
    expect_at_least(evaluate(data, tables.path(), "nao_uva_2013", "detection_ransac"), 0.88, 0.94);
    expect_at_least(evaluate(data, tables.path(), "nao_uva_2013", "detection_ransac_tuned"), 0.94, 0.94);
    evaluate(data, tables.path(), "nao_uva_2013", "detection_histogram");
}

}  // namespace
}  // namespace goalmouth
