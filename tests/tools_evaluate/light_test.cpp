#include "tools/evaluate/light.h"

#include "tests/support/evaluate_command.h"

#include <CLI/Error.hpp>
#include <gmock/gmock.h>

namespace goalmouth {
namespace {

using test::EvaluateCommand;
using testing::HasSubstr;
using Json = nlohmann::ordered_json;

using LightCommand = EvaluateCommand;

TEST(LightPath, GoesEvenlyFromOneToTheOther) {
    const LightPlace own{1.0, 4000.0}, other{0.25, 2000.0};
    EXPECT_EQ(light_between(own, other, 0.0), own);
    EXPECT_EQ(light_between(own, other, 1.0), other);
    const LightPlace half = light_between(own, other, 0.5);
    EXPECT_NEAR(half.brightness, 0.5, 1e-9);
    EXPECT_NEAR(half.temperature, 1.0 / (0.5 / 4000.0 + 0.5 / 2000.0), 1e-6);
}

TEST(LightPath, FactorsAreThoseOfBlackBodies) {
    const Rgb same = light_factors({0.5, 4000.0}, 4000.0);
    EXPECT_NEAR(same.r, 0.5, 1e-6);
    EXPECT_NEAR(same.b, 0.5, 1e-6);
    const Rgb warm = light_factors({2.0, 2700.0}, 4000.0);
    EXPECT_GT(warm.r, 2.6F);
    EXPECT_NEAR(warm.g, 2.0, 1e-6);
    EXPECT_LT(warm.b, 1.2F);
}

TEST_F(LightCommand, JudgesEachLightWithAndWithoutAdapting) {
    const std::vector<std::string> small = {
        "light",   "--scene",       "flat",      "--brightness",      "0.15", "--size",
        "320x240", "--temperature", "4000,6500", "--frames-per-cell", "1"};
    const auto with = [&](std::vector<std::string> more) {
        std::vector<std::string> all = small;
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    ASSERT_EQ(run(with({"--json", path("a.json"), "--jobs", "1", "--report", path("report")})), 0);
    EXPECT_THAT(printed, HasSubstr("Asked are 97 % in every light"));
    const Json a = json("a.json");
    EXPECT_TRUE(a["complete"].get<bool>());
    const Json& lights = a["lights"];
    // The scene's own, darker, warmer; the extremes together (the own temperature is none of them).
    ASSERT_EQ(lights.size(), 4U);
    const Json& own = lights[0];
    EXPECT_EQ(own["brightness"], 1.0);
    EXPECT_EQ(own["fixed"]["kept"], own["fixed"]["found"]);
    int posts = 0;
    for (const Json& cell : own["cells"]) posts += cell["fixed"]["posts"].get<int>();
    EXPECT_EQ(own["fixed"]["posts"], posts);
    const Json& dark = lights[1];
    EXPECT_EQ(dark["brightness"], 0.15);
    EXPECT_EQ(dark["temperature_k"], own["temperature_k"]);
    EXPECT_EQ(dark["fixed"]["posts"], own["fixed"]["posts"]) << "the same views in every light";
    EXPECT_GT(dark["adapting"]["found"], dark["fixed"]["found"]);
    EXPECT_THAT(text("report/index.html"), HasSubstr("Posts found by brightness"));

    ASSERT_EQ(run(with({"--json", path("b.json"), "--jobs", "3"})), 0);
    EXPECT_EQ(json("b.json")["lights"], lights) << "never changes with the number of threads";
}

TEST_F(LightCommand, RefusesWhatMakesNoSense) {
    EXPECT_THAT(refusal({"light"}), HasSubstr("nothing to write"));
    EXPECT_THAT(refusal({"light", "--json", path("a.json"), "--scene", "flat,lit"}),
                HasSubstr("one scene at a time"));
    EXPECT_THAT(refusal({"light", "--json", path("a.json"), "--detectors", "nosuch"}), HasSubstr("nosuch"));
    EXPECT_THROW(run({"light", "--json", path("a.json"), "--brightness", "0"}), CLI::ValidationError);
}

}  // namespace
}  // namespace goalmouth
