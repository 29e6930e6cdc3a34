#include "core/evaluation/evaluation_scene.h"
#include "core/field/field.h"
#include "core/geometry/camera.h"
#include "core/process/configuration.h"
#include "core/process/graph.h"
#include "core/simulation/image_formation.h"
#include "tools/goalmouth/registry.h"

#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

// What ships in config/ is what the programs take, all of it, and what the code says its defaults are.
namespace goalmouth {
namespace {

const std::filesystem::path config = std::filesystem::path(GOALMOUTH_SOURCE_DIR) / "config";

void collect_keys(const YAML::Node& node, const std::string& prefix,
                  std::map<std::string, YAML::Node>& keys) {
    for (const auto& entry : node) {
        const std::string key = prefix + entry.first.Scalar();
        if (entry.second.IsMap()) {
            collect_keys(entry.second, key + ".", keys);
        } else {
            keys.emplace(key, entry.second);
        }
    }
}

std::vector<std::filesystem::path> yaml_files(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".yaml") files.push_back(entry.path());
    }
    return files;
}

void expect_every_parameter(const std::filesystem::path& file, const std::vector<ParameterInfo>& parameters) {
    std::map<std::string, YAML::Node> keys;
    collect_keys(YAML::LoadFile(file.string()), "", keys);
    for (const auto& parameter : parameters) {
        EXPECT_TRUE(keys.contains(parameter.key)) << file << " lacks " << parameter.key;
        keys.erase(parameter.key);
    }
    for (const auto& [key, value] : keys) ADD_FAILURE() << file << " has an unknown key " << key;
}

TEST(ShippedConfig, HasAFileForEveryModuleThatListsEveryParameter) {
    for (const ModuleType& type : module_types()) {
        const auto file = config / "modules" / (type.info.executable + ".yaml");
        ASSERT_TRUE(std::filesystem::exists(file)) << file;
        expect_every_parameter(file, type.parameters);
    }
}

TEST(ShippedConfig, ScenesLoadAndListEveryParameter) {
    const auto files = yaml_files(config / "scenes");
    EXPECT_GE(files.size(), 5U);
    for (const auto& file : files) {
        EXPECT_NO_THROW(load_parameters<ImageFormationParameters>(file)) << file;
        expect_every_parameter(file, list_parameters<ImageFormationParameters>());
    }
}

TEST(ShippedConfig, EvaluationScenesLoadAndListEveryParameter) {
    const auto files = yaml_files(config / "evaluation");
    EXPECT_GE(files.size(), 4U);
    for (const auto& file : files) {
        const auto parameters = load_parameters<EvaluationSceneParameters>(file);
        EXPECT_TRUE(std::filesystem::exists(parameters.scene)) << file << ": " << parameters.scene;
        expect_every_parameter(file, list_parameters<EvaluationSceneParameters>());
    }
}

TEST(ShippedConfig, HoldsTheDefaults) {
    for (const ModuleType& type : module_types()) {
        const auto file = config / "modules" / (type.info.executable + ".yaml");
        std::map<std::string, YAML::Node> keys;
        collect_keys(YAML::LoadFile(file.string()), "", keys);
        for (const auto& parameter : type.parameters) {
            if (parameter.valid == "the name of a file")
                continue;  // where files stand is the configuration's to say
            const YAML::Node ours = keys.at(parameter.key);
            const YAML::Node theirs = YAML::Load(parameter.value);
            if (ours.IsScalar() && theirs.IsScalar()) {
                double a = 0.0;
                double b = 0.0;
                if (YAML::convert<double>::decode(ours, a) && YAML::convert<double>::decode(theirs, b)) {
                    EXPECT_DOUBLE_EQ(a, b) << file << ": " << parameter.key;
                } else {
                    EXPECT_EQ(ours.Scalar(), theirs.Scalar()) << file << ": " << parameter.key;
                }
            } else {
                EXPECT_EQ(YAML::Dump(ours), YAML::Dump(theirs)) << file << ": " << parameter.key;
            }
        }
    }
}

TEST(ShippedConfig, FieldsLoad) {
    const auto files = yaml_files(config / "fields");
    EXPECT_GE(files.size(), 2U);
    for (const auto& file : files) EXPECT_NO_THROW(load_parameters<Field>(file)) << file;
}

TEST(ShippedConfig, CamerasLoad) {
    const auto files = yaml_files(config / "cameras");
    EXPECT_GE(files.size(), 2U);
    for (const auto& file : files) EXPECT_NO_THROW(load_parameters<Intrinsics>(file)) << file;
}

TEST(ShippedConfig, GraphsLoad) {
    const auto files = yaml_files(config / "graphs");
    EXPECT_GE(files.size(), 4U);
    GraphOptions options;
    options.describe = describe_module;
    for (const auto& file : files) {
        try {
            load_graph(file.string(), options);
        } catch (const ConfigurationError& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

// Each parameter of each module, set to something it cannot be, stops the program with a sentence that names
// it.
TEST(ShippedConfig, EveryKeyIsCheckedWhenWrong) {
    int checked = 0;
    for (const ModuleType& type : module_types()) {
        for (const auto& parameter : type.parameters) {
            if (parameter.valid == "a text") continue;  // any text will do
            Configuration configuration;
            configuration.set(parameter.key, "[nonsense, {}]", "--set");
            Status status;
            struct NoBus : Bus {
                void publish(const std::string&, std::span<const std::uint8_t>) override {}
                void subscribe(const std::string&, Delivery, Handler) override {}
                void subscribe_all(ChannelHandler) override {}
                bool dispatch(std::chrono::milliseconds) override { return false; }
            } bus;
            ModuleContext context{bus, status, "test", 1, {}};
            try {
                type.create(context, configuration);
                ADD_FAILURE() << type.info.executable << " takes nonsense for " << parameter.key;
            } catch (const ConfigurationError& error) {
                EXPECT_NE(std::string(error.what()).find(parameter.key), std::string::npos) << error.what();
                EXPECT_NE(std::string(error.what()).find("is not"), std::string::npos) << error.what();
            }
            ++checked;
        }
    }
    EXPECT_GT(checked, 30);
}

}  // namespace
}  // namespace goalmouth
