#include "core/process/graph_value.h"

#include "core/process/graph_program.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

TEST(GraphValue, IsJudgedByTheProgramsRule) {
    EXPECT_TRUE(value_is_valid("3.5", "a number in 0…5"));
    EXPECT_FALSE(value_is_valid("5.5", "a number in 0…5"));
    EXPECT_FALSE(value_is_valid("fast", "a number"));
    EXPECT_FALSE(value_is_valid(".nan", "a number"));
    EXPECT_FALSE(value_is_valid("[1]", "a number"));
    EXPECT_TRUE(value_is_valid("-1e3", "a number of at most 0"));
    EXPECT_FALSE(value_is_valid("-1e3", "a number of at least -10"));
    EXPECT_FALSE(value_is_valid("0", "a number above 0"));
    EXPECT_TRUE(value_is_valid("1e-9", "a number above 0"));
    EXPECT_TRUE(value_is_valid("7", "a whole number in 1…100000"));
    EXPECT_FALSE(value_is_valid("7.5", "a whole number in 1…100000"));
    EXPECT_TRUE(value_is_valid("[1, 2.5]", "a list of numbers in 0…3"));
    EXPECT_FALSE(value_is_valid("[1, 4]", "a list of numbers in 0…3"));
    EXPECT_FALSE(value_is_valid("1", "a list of numbers"));
    EXPECT_TRUE(value_is_valid("true", "true or false"));
    EXPECT_FALSE(value_is_valid("perhaps", "true or false"));
    EXPECT_TRUE(value_is_valid("jpeg", "one of: raw, jpeg"));
    EXPECT_FALSE(value_is_valid("jpe", "one of: raw, jpeg"));
    EXPECT_TRUE(value_is_valid("\"\"", "the name of a file"));
    EXPECT_FALSE(value_is_valid("[a]", "a text"));
    EXPECT_FALSE(value_is_valid("[1", "a text"));
    EXPECT_TRUE(value_is_valid("whatever", "a colour somebody else's program knows"));
}

TEST(GraphValue, DefaultsOfOurOwnParametersHold) {
    ParameterLister lister;
    double number = 0.25;
    int whole = 3;
    bool flag = true;
    std::string word = "raw";
    std::vector<double> list = {1, 2};
    lister("a", number, above(0), "m", "");
    lister("b", whole, Range{1, 5}, "1", "");
    lister("c", flag, "");
    lister("d", word, Choice{"raw", "jpeg"}, "");
    lister("e", list, at_least(0), "m", "");
    lister("f", word, File{}, "");
    lister("g", word, Text{}, "");
    for (const auto& parameter : lister.parameters) {
        EXPECT_TRUE(value_is_valid(parameter.value, parameter.valid))
            << parameter.value << " is not " << parameter.valid;
        const std::string wrong = parameter.key == "f" || parameter.key == "g" ? "[]" : "-7";
        EXPECT_FALSE(value_is_valid(wrong, parameter.valid)) << wrong << " is " << parameter.valid;
    }
}

TEST(ProgramDescriptionTest, IsReadAsModulesPrintIt) {
    const ProgramDescription read = parse_description(
        "executable: finder\nsummary: finds\nsubscribes:\n  - channel: IMAGE\n    type: image_t\n    "
        "meaning: m\n    optional: true\n"
        "publishes:\n  []\nparameters:\n  - key: walk.speed\n    value: \"0.2\"\n    valid: a number\n    "
        "unit: m/s\n    meaning: how fast\n");
    EXPECT_EQ(read.info.executable, "finder");
    ASSERT_EQ(read.info.subscribes.size(), 1U);
    EXPECT_TRUE(read.info.subscribes[0].optional);
    EXPECT_TRUE(read.info.publishes.empty());
    ASSERT_EQ(read.parameters.size(), 1U);
    EXPECT_EQ(read.parameters[0].unit, "m/s");
    EXPECT_THROW(parse_description("usage: finder FILE"), std::runtime_error);
    EXPECT_THROW(parse_description("{"), std::runtime_error);
}

}  // namespace
}  // namespace goalmouth
