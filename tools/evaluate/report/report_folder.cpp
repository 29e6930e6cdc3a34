#include "tools/evaluate/report/report_folder.h"

#include "core/process/configuration.h"
#include "tools/goalmouth/output.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <optional>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace goalmouth {
namespace {

namespace fs = std::filesystem;

constexpr const char* last_file = "index.html";
constexpr const char* replaced_folder = ".replaced";  // in the temporary folder: the files of the old report

[[noreturn]] void fail(const std::string& option, const std::string& what) {
    throw ConfigurationError(option.empty() ? what : option + ": " + what);
}

/// Without links, "." and "..", so that what lies beside the folder is known.
fs::path resolved(const fs::path& target, const std::string& option) {
    if (target.empty()) fail(option, "the report's folder has no name");
    std::error_code problem;
    fs::path path = fs::weakly_canonical(fs::absolute(target), problem);
    if (problem) fail(option, fmt::format("the folder {}: {}", target.string(), problem.message()));
    if (!path.has_filename()) path = path.parent_path();  // "report/"
    return path;
}

bool writable(const fs::path& folder) {
    return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

bool same_file_system(const fs::path& a, const fs::path& b) {
    struct stat of_a {};
    struct stat of_b {};
    return ::stat(a.c_str(), &of_a) == 0 && ::stat(b.c_str(), &of_b) == 0 && of_a.st_dev == of_b.st_dev;
}

/// The folder itself or the nearest above it that is there.
fs::path nearest_existing(fs::path folder) {
    std::error_code ignored;
    while (!fs::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
    return folder;
}

/// All files below `folder`, relative to it, index.html last.
std::vector<fs::path> files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (!entry.is_directory()) files.push_back(entry.path().lexically_relative(folder));
    }
    std::sort(files.begin(), files.end());
    std::stable_partition(files.begin(), files.end(), [](const fs::path& f) { return f != last_file; });
    return files;
}

/// Keeps what stands at `file` under a second name, so that the move over it is one step and can be undone.
void keep(const fs::path& file, const fs::path& kept) {
    fs::create_directories(kept.parent_path());
    std::error_code no_links;
    fs::create_hard_link(file, kept, no_links);
    if (no_links) fs::copy_file(file, kept);
}

struct Move {
    fs::path to;
    std::optional<fs::path> replaced;
};

void undo(const std::vector<Move>& moves) {
    for (auto move = moves.rbegin(); move != moves.rend(); ++move) {
        std::error_code ignored;
        if (move->replaced) {
            fs::rename(*move->replaced, move->to, ignored);
        } else {
            fs::remove(move->to, ignored);
        }
    }
}

}  // namespace

void expect_report_folder(const fs::path& target, const std::string& option) {
    const fs::path folder = resolved(target, option);
    const fs::path existing = nearest_existing(folder);
    std::error_code ignored;
    if (!fs::is_directory(existing, ignored)) {
        fail(option, existing == folder
                         ? fmt::format("{} is a file, expected a folder for the report", folder.string())
                         : fmt::format("the folder {} cannot be made: {} is a file", folder.string(),
                                       existing.string()));
    }
    if (!writable(existing))
        fail(option,
             fmt::format("the folder {} cannot be {}: {}: {}", folder.string(),
                         existing == folder ? "written" : "made", existing.string(), std::strerror(errno)));
}

ReportFolder::ReportFolder(const fs::path& target, const std::string& option)
    : target_(resolved(target, option)), option_(option) {
    expect_report_folder(target, option);
    const fs::path above = target_.parent_path();
    std::error_code ignored;
    const bool beside = !fs::exists(target_, ignored) ||
                        (target_ != above && writable(above) && same_file_system(target_, above));
    const fs::path place = beside ? above : target_;
    make_output_folder(place, option_);
    work_.emplace(place, "." + target_.filename().string() + "-", option_);
}

void ReportFolder::write(const std::string& name, const std::string& text) {
    const fs::path relative = fs::path(name).lexically_normal();
    if (relative.empty() || relative.is_absolute() || *relative.begin() == ".." || !relative.has_filename())
        fail(option_, "a report's file '" + name + "' would leave its folder");
    make_output_folder((work_->path() / relative).parent_path(), option_);
    write_text(work_->path() / relative, text, option_);
}

void ReportFolder::publish() {
    std::vector<Move> moves;
    try {
        const std::vector<fs::path> files = files_in(work_->path());
        for (const fs::path& file : files) {
            if (fs::is_directory(target_ / file))
                fail(option_, fmt::format("the folder {}: {} is a folder there, but a file of the report",
                                          target_.string(), file.string()));
        }
        fs::create_directories(target_);
        if (::chmod(work_->path().c_str(), 0755) != 0)
            fail(option_, work_->path().string() + ": " + std::strerror(errno));
        for (const fs::path& file : files) {
            Move move{target_ / file, std::nullopt};
            fs::create_directories(move.to.parent_path());
            if (fs::exists(fs::symlink_status(move.to))) {
                move.replaced = work_->path() / replaced_folder / file;
                keep(move.to, *move.replaced);
            }
            fs::rename(work_->path() / file, move.to);
            moves.push_back(std::move(move));
        }
    } catch (const fs::filesystem_error& error) {
        undo(moves);
        fail(option_, fmt::format("the folder {} cannot be written: {}: {}", target_.string(),
                                  error.path1().string(), error.code().message()));
    } catch (...) {
        undo(moves);
        throw;
    }
    work_.reset();
}

}  // namespace goalmouth
