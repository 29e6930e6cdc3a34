#pragma once

#include <string>

namespace goalmouth {

/// The command line that made a result, written anew so that a shell takes it as it stands.
class CommandLine {
  public:
    explicit CommandLine(const std::string& start) : text_(start) {}
    CommandLine& word(const std::string& word);
    /// Nothing where the value is empty.
    CommandLine& option(const std::string& name, const std::string& value);
    const std::string& text() const { return text_; }

  private:
    std::string text_;
};

}  // namespace goalmouth
