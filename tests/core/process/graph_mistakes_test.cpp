#include "tests/core/process/graph_fixture.h"

#include <ostream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using testing::HasSubstr;

struct Mistake {
    const char* name;
    std::string old_text;
    std::string new_text;
    std::vector<std::string> said;
};

void PrintTo(const Mistake& mistake, std::ostream* out) {
    *out << mistake.name;
}

class GraphMistake : public GraphFileTest, public testing::WithParamInterface<Mistake> {};

TEST_P(GraphMistake, IsSaidWithPlaceAndWhatWouldBeValid) {
    const Mistake& mistake = GetParam();
    const std::string error = error_of(with(mistake.old_text, mistake.new_text));
    for (const auto& part : mistake.said) EXPECT_THAT(error, HasSubstr(part));
}

const std::string detection = "  - name: detection\n    executable: finder\n";

INSTANTIATE_TEST_SUITE_P(
    EachKeyInTurn, GraphMistake,
    testing::Values(
        Mistake{"UnknownKey",
                "seed: 7",
                "sed: 7",
                {"graph.yaml:1: unknown key 'sed'", "did you mean 'seed'", "processes"}},
        Mistake{"KeyTwice", "seed: 7", "seed: 7\nseed: 8", {"graph.yaml:2: key 'seed' given twice"}},
        Mistake{"NotYaml", "seed: 7", "seed: [7", {"graph.yaml:", "not YAML"}},
        Mistake{"SeedText",
                "seed: 7",
                "seed: seven",
                {"graph.yaml:1: seed: 'seven' is not a whole number of at least 0"}},
        Mistake{"SeedNegative", "seed: 7", "seed: -7", {"graph.yaml:1: seed: '-7' is not"}},
        Mistake{"SeedList",
                "seed: 7",
                "seed: [7]",
                {"graph.yaml:1: seed: expected a whole number", "not a list"}},
        Mistake{"NameList", "seed: 7", "name: [a]", {"graph.yaml:1: name: expected a name, not a list"}},
        Mistake{
            "NameEmpty", "seed: 7", "name: ''", {"graph.yaml:1: name: expected a name, not an empty text"}},
        Mistake{"UrlNone",
                "udpm://239.255.76.67:7667?ttl=0",
                "239.255.76.67",
                {"graph.yaml:2: lcm_url:", "valid: udpm://"}},
        Mistake{"UrlProvider", "udpm://239", "upmd://239", {"graph.yaml:2: lcm_url:", "no provider 'upmd'"}},
        Mistake{"UrlUnicast",
                "udpm://239.255.76.67",
                "udpm://192.168.0.1",
                {"graph.yaml:2:", "no multicast group"}},
        Mistake{"UrlPort", ":7667", ":766700", {"graph.yaml:2:", "port is not a number in 1…65535"}},
        Mistake{
            "UrlOption", "ttl=0", "tll=0", {"graph.yaml:2:", "unknown option 'tll'", "did you mean 'ttl'"}},
        Mistake{"UrlTtl", "ttl=0", "ttl=300", {"graph.yaml:2:", "ttl is not a number in 0…255"}},
        Mistake{"UrlMemory",
                "udpm://239.255.76.67:7667?ttl=0",
                "memq://",
                {"graph.yaml:2:", "between processes"}},
        Mistake{"CommonText",
                "common:\n  field: fields/small.yaml",
                "common: field",
                {"graph.yaml:3: common: expected 'key: value'"}},
        Mistake{"CommonUnknown",
                "  field: fields/small.yaml",
                "  feild: fields/small.yaml",
                {"graph.yaml:4: common: no process has a parameter 'feild'", "did you mean 'field'"}},
        Mistake{"ExternalText",
                "seed: 7",
                "external: ODOMETRY",
                {"graph.yaml:1: external: expected a list of channels"}},
        Mistake{"ExternalName",
                "seed: 7",
                "external: ['A B']",
                {"graph.yaml:1: external: 'A B' is not the name of a channel"}},
        Mistake{"ExternalUnread",
                "seed: 7",
                "external: [ODOMTRY]",
                {"graph.yaml:1: external: no process subscribes ODOMTRY", "did you mean 'ODOMETRY'"}},
        Mistake{"ExternalInside",
                "seed: 7",
                "external: [IMAGE]",
                {"graph.yaml:6: camera: publishes IMAGE", "'external'"}},
        Mistake{"ExtendsMissing",
                "seed: 7",
                "extends: none.yaml",
                {"graph.yaml:1: extends: none.yaml does not exist"}},
        Mistake{
            "ExtendsItself", "seed: 7", "extends: graph.yaml", {"graph.yaml:1: extends: goes in a circle"}},
        Mistake{"ExtendsList",
                "seed: 7",
                "extends: [a]",
                {"graph.yaml:1: extends: expected the name of a graph file"}},
        Mistake{"ProcessesText", "processes:", "processes: none\nname:", {"graph.yaml:", "expected"}},
        Mistake{"ProcessText",
                detection,
                "  - detection\n",
                {"graph.yaml:9: an entry of processes: expected 'key: value'"}},
        Mistake{"ProcessUnknownKey",
                "    executable: finder",
                "    executable: finder\n    argumets: []",
                {"graph.yaml:11: unknown key 'argumets'", "did you mean 'arguments'"}},
        Mistake{"ProcessNoName",
                detection,
                "  - executable: finder\n",
                {"graph.yaml:9: an entry of processes has no 'name'"}},
        Mistake{
            "ProcessNameTaken", "name: detection", "name: camera", {"graph.yaml:9: name: 'camera' is taken"}},
        Mistake{"ProcessNameDotted",
                "name: detection",
                "name: de.tection",
                {"graph.yaml:9: name: 'de.tection' is not a name"}},
        Mistake{"ProcessNoExecutable",
                detection,
                "  - name: detection\n",
                {"graph.yaml:9: detection: has no 'executable'"}},
        Mistake{"ExecutableUnknown",
                "executable: finder",
                "executable: findre",
                {"graph.yaml:10: detection: executable: no program 'findre'", "looked in", "on PATH"}},
        Mistake{"ExecutablePath",
                "executable: finder",
                "executable: ./findre",
                {"graph.yaml:10: detection: executable: findre does not exist"}},
        Mistake{"ExecutableNoProgram",
                "executable: finder",
                "executable: ./graph.yaml",
                {"graph.yaml:10: detection: executable: graph.yaml is not a program that may be run"}},
        Mistake{"ExecutableSilent",
                "executable: finder",
                "executable: /bin/false",
                {"graph.yaml:10: detection: executable: asked '/bin/false --describe': exit code 1",
                 "'subscribes'"}},
        Mistake{"ExecutableNonsense",
                "executable: finder",
                "executable: /bin/echo",
                {"graph.yaml:10: detection: executable: asked", "not a description"}},
        Mistake{"ConfigMissing",
                "    executable: finder",
                "    executable: finder\n    config: none.yaml",
                {"graph.yaml:11: detection: config: none.yaml does not exist"}},
        Mistake{"ConfigList",
                "    executable: finder",
                "    executable: finder\n    config: [a]",
                {"graph.yaml:11: detection: config: expected the name of a file"}},
        Mistake{"ParametersText",
                "    executable: finder",
                "    executable: finder\n    parameters: much",
                {"graph.yaml:11: detection: parameters: expected 'key: value'"}},
        Mistake{"ParameterUnknown",
                "frames_per_second: 15",
                "frames_per_secnd: 15",
                {"graph.yaml:8: camera: unknown parameter 'frames_per_secnd' of source",
                 "did you mean 'frames_per_second'"}},
        Mistake{"ParameterValue",
                "frames_per_second: 15",
                "frames_per_second: fast",
                {"graph.yaml:8: camera: frames_per_second: 'fast' is not a number"}},
        Mistake{"CommonValue",
                "field: fields/small.yaml",
                "field: [a, b]",
                {"graph.yaml:4: camera: field: '[a, b]' is not the name of a file"}},
        Mistake{"ParameterUnknownNested",
                "walk: {speed",
                "walk: {sped",
                {"graph.yaml:8: camera: unknown parameter 'walk.sped'"}},
        Mistake{"ChannelUnused",
                "    executable: finder",
                "    executable: finder\n    channels: {POST: B}",
                {"graph.yaml:11: detection: channels: finder does not use a channel 'POST'",
                 "did you mean 'POSTS'"}},
        Mistake{"ChannelName",
                "    executable: finder",
                "    executable: finder\n    channels: {POSTS: 'a b'}",
                {"graph.yaml:11: detection: channels.POSTS: 'a b' is not the name of a channel"}},
        Mistake{"ChannelNameLong",
                "    executable: finder",
                "    executable: finder\n    channels: {POSTS: " + std::string(64, 'A') + "}",
                {"graph.yaml:11:", "longer than the 63 characters"}},
        Mistake{"ArgumentsText",
                "    executable: finder",
                "    executable: finder\n    arguments: -v",
                {"graph.yaml:11: detection: arguments: expected a list of texts"}},
        Mistake{"ChannelsList",
                "    executable: finder",
                "    executable: finder\n    channels: [A]",
                {"graph.yaml:11: detection: channels: expected 'key: value' lines, not a list"}},
        Mistake{"EnabledText",
                "    executable: finder",
                "    executable: finder\n    enabled: perhaps",
                {"graph.yaml:11: detection: enabled: expected true or false, not 'perhaps'"}},
        Mistake{"SubscribesText",
                "    executable: finder",
                "    executable: /bin/true\n    subscribes: IMAGE",
                {"graph.yaml:11: detection: subscribes: expected a list of channels"}},
        Mistake{"PublishesNoChannel",
                "    executable: finder",
                "    executable: /bin/true\n    publishes: [{type: posts_t}]",
                {"graph.yaml:11: detection: publishes: an entry has no 'channel'"}},
        Mistake{"NobodyPublishes",
                detection,
                "",
                {"graph.yaml:9: localisation: subscribes POSTS (posts_t), which nobody publishes"}},
        Mistake{"TwoPublish",
                detection,
                detection + "  - {name: second, executable: other_finder}\n",
                {"graph.yaml:11: second: publishes POSTS, which detection (graph.yaml:9) publishes too",
                 "'channels'"}},
        Mistake{"TypesDiffer",
                "executable: locator",
                "executable: odd\n  - {name: l, executable: locator}",
                {"graph.yaml:11: localisation: subscribes POSTS as pose_t, but detection (graph.yaml:9) "
                 "publishes posts_t"}}),
    [](const auto& mistake) { return std::string(mistake.param.name); });

}  // namespace
}  // namespace goalmouth
