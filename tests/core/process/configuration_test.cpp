#include "core/process/configuration.h"

#include "tests/support/data.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using testing::HasSubstr;

struct Gait {
    double speed = 0.2;
    bool sideways = false;
};

template <class Visitor>
void describe_parameters(Visitor& v, Gait& p) {
    v("speed", p.speed, Range{0.0, 1.0}, "m/s", "how fast it walks");
    v("sideways", p.sideways, "whether it may side-step");
}

struct Robot {
    int joints = 20;
    double height = 0.45;
    std::string eyes = "two";
    std::string table;
    std::string nickname = "op";
    std::vector<double> limits = {1.0, 2.0};
    Gait gait;
};

template <class Visitor>
void describe_parameters(Visitor& v, Robot& p) {
    v("joints", p.joints, Range{1, 40}, "1", "how many joints it has");
    v("height", p.height, above(0.0), "m", "how tall it is");
    v("eyes", p.eyes, Choice{"one", "two"}, "how many eyes");
    v("table", p.table, File{true}, "colour table");
    v("nickname", p.nickname, Text{}, "what people call it");
    v("limits", p.limits, Range{0.0, 9.0}, "rad", "joint limits");
    v.group("gait", p.gait, "how it walks");
}

Robot load(const std::string& text) {
    return load_parameters<Robot>(Configuration::from_text(text, "robot.yaml", "/robots"));
}

std::string error_of(const std::string& text) {
    try {
        load(text);
    } catch (const ConfigurationError& error) {
        return error.what();
    }
    return "no error";
}

TEST(Configuration, KeepsDefaultsOfAbsentKeys) {
    const Robot robot = load("joints: 12\n");
    EXPECT_EQ(robot.joints, 12);
    EXPECT_EQ(robot.height, 0.45);
    EXPECT_EQ(robot.gait.speed, 0.2);
    EXPECT_EQ(load("").joints, 20);
}

TEST(Configuration, ReadsEveryKind) {
    const Robot robot = load(
        "joints: 7\nheight: 1.5\neyes: one\ntable: tables/a.gmct\nnickname: Ada\nlimits: [0, 1.5]\n"
        "gait:\n  speed: 0.5\n  sideways: true\n");
    EXPECT_EQ(robot.joints, 7);
    EXPECT_EQ(robot.height, 1.5);
    EXPECT_EQ(robot.eyes, "one");
    EXPECT_EQ(robot.table, "/robots/tables/a.gmct") << "a path counts from its file's folder";
    EXPECT_EQ(robot.nickname, "Ada");
    EXPECT_EQ(robot.limits, (std::vector<double>{0.0, 1.5}));
    EXPECT_EQ(robot.gait.speed, 0.5);
    EXPECT_TRUE(robot.gait.sideways);
}

TEST(Configuration, NamesFileLineKeyAndWhatIsValid) {
    EXPECT_EQ(error_of("height: 1\njoints: 99\n"),
              "robot.yaml:2: joints: '99' is not a whole number in 1…40");
    EXPECT_EQ(error_of("joints: many\n"), "robot.yaml:1: joints: 'many' is not a whole number in 1…40");
    EXPECT_EQ(error_of("joints: 3.5\n"), "robot.yaml:1: joints: '3.5' is not a whole number in 1…40");
    EXPECT_EQ(error_of("eyes: three\n"), "robot.yaml:1: eyes: 'three' is not one of: one, two");
    EXPECT_EQ(error_of("gait:\n  sideways: perhaps\n"),
              "robot.yaml:2: gait.sideways: 'perhaps' is not true or false");
    EXPECT_THAT(error_of("height: 0\n"), HasSubstr("robot.yaml:1: height: '0' is not a number above 0"));
    EXPECT_THAT(error_of("height: .nan\n"), HasSubstr("height: '.nan' is not"));
    EXPECT_THAT(error_of("height: [1]\n"), HasSubstr("height: a list or group is not"));
    EXPECT_THAT(error_of("height:\n"), HasSubstr("height: nothing is not"));
    EXPECT_THAT(error_of("limits: 3\n"), HasSubstr("limits: '3' is not a list of numbers"));
    EXPECT_THAT(error_of("limits: [1, 22]\n"),
                HasSubstr("limits: a list or group is not a list of numbers in 0…9"));
    EXPECT_THAT(error_of("gait: 3\n"), HasSubstr("robot.yaml:1: gait: expected 'key: value' lines"));
}

TEST(Configuration, RefusesUnknownAndRepeatedKeys) {
    EXPECT_THAT(error_of("jionts: 3\n"),
                HasSubstr("robot.yaml:1: unknown key 'jionts'; did you mean 'joints'?"));
    EXPECT_THAT(error_of("gait:\n  sped: 1\n"),
                HasSubstr("robot.yaml:2: unknown key 'gait.sped'; did you mean 'speed'?"));
    EXPECT_THAT(error_of("joints: 3\njoints: 4\n"), HasSubstr("robot.yaml:2: joints: given twice"));
}

TEST(Configuration, RefusesWhatIsNotYaml) {
    EXPECT_THAT(error_of("joints: [1, 2\nheight: 3\n"), HasSubstr("robot.yaml:"));
    EXPECT_THAT(error_of("- a\n- b\n"), HasSubstr("robot.yaml:1: expected 'key: value' lines"));
    EXPECT_THAT(error_of("just words"), HasSubstr("expected 'key: value' lines"));
}

TEST(Configuration, NamesAMissingFile) {
    test::TemporaryFolder folder;
    try {
        Configuration::from_file(folder.path() / "none.yaml");
        FAIL() << "no error";
    } catch (const ConfigurationError& error) {
        EXPECT_THAT(error.what(), HasSubstr("none.yaml: cannot be read"));
    }
    EXPECT_THROW(Configuration::from_file(folder.path()), ConfigurationError);
}

TEST(Configuration, AFileOfZeroBytesIsNoConfiguration) {
    test::TemporaryFolder folder;
    std::ofstream(folder.path() / "empty.yaml");
    EXPECT_THROW(Configuration::from_file(folder.path() / "empty.yaml"), ConfigurationError);
    std::ofstream(folder.path() / "comment.yaml") << "# all as it was\n";
    EXPECT_EQ(load_parameters<Robot>(Configuration::from_file(folder.path() / "comment.yaml")).joints, 20);
}

TEST(Configuration, OverridesWinAndAreChecked) {
    Configuration configuration =
        Configuration::from_text("joints: 3\ngait:\n  speed: 0.1\n", "robot.yaml", "/robots");
    configuration.set("joints", "5", "--set");
    configuration.set("gait.speed", "0.9", "--set");
    configuration.set("table", "t.gmct", "demo.yaml:3", "/graphs");
    const Robot robot = load_parameters<Robot>(configuration);
    EXPECT_EQ(robot.joints, 5);
    EXPECT_EQ(robot.gait.speed, 0.9);
    EXPECT_EQ(robot.table, "/graphs/t.gmct");
    EXPECT_EQ(configuration.text("joints"), "5");
    EXPECT_EQ(configuration.text("nickname"), "");

    configuration.set("gait.sped", "1", "--set");
    EXPECT_THROW(
        {
            try {
                load_parameters<Robot>(configuration);
            } catch (const ConfigurationError& error) {
                EXPECT_THAT(error.what(),
                            HasSubstr("--set: unknown key 'gait.sped'; did you mean 'gait.speed'?"));
                throw;
            }
        },
        ConfigurationError);
}

TEST(Configuration, PrintedParametersLoadBack) {
    Robot robot;
    robot.joints = 9;
    robot.height = 0.123456789012345;
    robot.nickname = "a: b # c";
    robot.gait.sideways = true;
    const Robot again = load(parameters_as_yaml(list_parameters(robot)));
    EXPECT_EQ(again.joints, 9);
    EXPECT_EQ(again.height, 0.123456789012345);
    EXPECT_EQ(again.nickname, "a: b # c");
    EXPECT_TRUE(again.gait.sideways);
    EXPECT_EQ(again.limits, robot.limits);
}

}  // namespace
}  // namespace goalmouth
