#pragma once

#include "core/parameters/parameters.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace goalmouth {

/// A mistake in a configuration, with file, line, key and what would be valid in its text. Programs print it
/// and exit with 2.
class ConfigurationError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// One YAML document, with overrides laid over it. Remembers where each value stands, for errors and for
/// relative paths.
class Configuration {
  public:
    /// No file at all: every parameter keeps its default unless set().
    Configuration();
    ~Configuration();
    Configuration(const Configuration&);
    Configuration& operator=(const Configuration&);

    /// Throws ConfigurationError where the file is missing or not YAML.
    static Configuration from_file(const std::filesystem::path& file);
    /// `name` stands for the file in errors; relative paths count from `folder`.
    static Configuration from_text(const std::string& text, const std::string& name,
                                   const std::filesystem::path& folder = std::filesystem::current_path());

    /// Overrides one key ("walk.speed" for a nested one) by text as YAML would hold it. `origin` stands for
    /// the file in errors, e.g. "--set" or "demo.yaml:14"; relative paths count from `folder`.
    void set(const std::string& key, const std::string& value, const std::string& origin,
             const std::filesystem::path& folder = std::filesystem::current_path());

    /// A text value as the parameter `key` holds it now, without checks; "" if absent.
    std::string text(const std::string& key) const;
    /// The same for a parameter that names a file: a relative name counts from where it stands.
    std::string file(const std::string& key) const;

  private:
    friend class ParameterReader;
    struct Data;
    struct Found;
    std::optional<Found> find(const std::string& key) const;
    std::shared_ptr<const Data> data_;
};

/// One parameter, for help texts and checks.
struct ParameterInfo {
    std::string key;    // "walk.speed"
    std::string value;  // as YAML
    std::string valid;  // what would be valid: "a number in 0…1", "one of: image, field"
    std::string unit;   // "px", "1" for none, "" where a unit makes no sense
    std::string meaning;
};

/// Visitor that fills a struct from a Configuration and collects what is wrong.
class ParameterReader {
  public:
    explicit ParameterReader(const Configuration& configuration);
    ~ParameterReader();

    void operator()(const char* key, double& value, const Range& range, const char* unit,
                    const char* meaning);
    void operator()(const char* key, float& value, const Range& range, const char* unit, const char* meaning);
    void operator()(const char* key, int& value, const Range& range, const char* unit, const char* meaning);
    void operator()(const char* key, std::vector<double>& value, const Range& range, const char* unit,
                    const char* meaning);
    void operator()(const char* key, bool& value, const char* meaning);
    void operator()(const char* key, std::string& value, const Choice& choice, const char* meaning);
    void operator()(const char* key, std::string& value, const File& file, const char* meaning);
    void operator()(const char* key, std::string& value, const Text& text, const char* meaning);

    template <class Group>
    void group(const char* key, Group& value, const char* meaning) {
        enter(key, meaning);
        describe_parameters(*this, value);
        leave();
    }

    /// Throws ConfigurationError for the first mistake, unknown keys included.
    void finish();

  private:
    struct State;
    void enter(const char* key, const char* meaning);
    void leave();
    std::unique_ptr<State> state_;
};

/// Visitor that lists parameters with the values they have.
class ParameterLister {
  public:
    void operator()(const char* key, double& value, const Range& range, const char* unit,
                    const char* meaning);
    void operator()(const char* key, float& value, const Range& range, const char* unit, const char* meaning);
    void operator()(const char* key, int& value, const Range& range, const char* unit, const char* meaning);
    void operator()(const char* key, std::vector<double>& value, const Range& range, const char* unit,
                    const char* meaning);
    void operator()(const char* key, bool& value, const char* meaning);
    void operator()(const char* key, std::string& value, const Choice& choice, const char* meaning);
    void operator()(const char* key, std::string& value, const File& file, const char* meaning);
    void operator()(const char* key, std::string& value, const Text& text, const char* meaning);

    template <class Group>
    void group(const char* key, Group& value, const char*) {
        const std::string outer = prefix_;
        prefix_ += std::string(key) + ".";
        describe_parameters(*this, value);
        prefix_ = outer;
    }

    std::vector<ParameterInfo> parameters;

  private:
    std::string prefix_;
};

/// Fills a parameter struct, checked; keys absent from the configuration keep their defaults. Throws
/// ConfigurationError.
template <class Parameters>
Parameters load_parameters(const Configuration& configuration) {
    Parameters parameters;
    ParameterReader reader(configuration);
    describe_parameters(reader, parameters);
    reader.finish();
    return parameters;
}

template <class Parameters>
Parameters load_parameters(const std::filesystem::path& file) {
    return load_parameters<Parameters>(Configuration::from_file(file));
}

/// For parameters that name a file and may be empty: every value at its default then.
template <class Parameters>
Parameters load_parameters_or_defaults(const std::filesystem::path& file) {
    return file.empty() ? Parameters{} : load_parameters<Parameters>(file);
}

template <class Parameters>
std::vector<ParameterInfo> list_parameters(Parameters parameters = {}) {
    ParameterLister lister;
    describe_parameters(lister, parameters);
    return std::move(lister.parameters);
}

/// The parameters as a commented YAML file that loads back to the same values.
std::string parameters_as_yaml(const std::vector<ParameterInfo>& parameters);

}  // namespace goalmouth
