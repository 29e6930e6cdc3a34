#include "core/imaging/directory_source.h"

#include "core/imaging/file_error.h"

#include <algorithm>
#include <utility>

namespace goalmouth {

DirectorySource::DirectorySource(const std::filesystem::path& path, std::optional<ImageSize> raw_size,
                                 bool loop, SourceLog log, FrameMemory* memory)
    : raw_size_(raw_size), loop_(loop), log_(std::move(log)), buffer_(memory) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) {
        files_.push_back(path);
        return;
    }
    if (!std::filesystem::is_directory(path, error))
        throw FileError(path.string() + ": no such folder or image");
    std::filesystem::directory_iterator entries(path, error);
    if (error) throw FileError(path.string() + ": cannot be listed: " + error.message());
    std::size_t others = 0;
    for (const auto& entry : entries) {
        if (is_image_name(entry.path()) && !entry.is_directory(error)) {
            files_.push_back(entry.path());
        } else {
            ++others;
        }
    }
    if (files_.empty()) {
        throw FileError(path.string() + ": holds no image (" + std::to_string(others) +
                        " other entries; images are named .png, .jpg, .jpeg, .ppm, .pgm, .bmp or .yuyv)");
    }
    std::sort(files_.begin(), files_.end());
}

ImageSource::Outcome DirectorySource::next(Captured& frame, std::chrono::milliseconds) {
    frame = {};
    for (;;) {
        if (at_ == files_.size()) {
            if (!loop_ || !any_this_round_) return Outcome::ended;
            at_ = 0;
            any_this_round_ = false;
        }
        const std::filesystem::path& file = files_[at_++];
        try {
            read_image(file, is_raw_image_name(file) ? raw_size_ : std::nullopt,
                       [&](ImageSize size) { return buffer_.prepare(frame, size.width, size.height); });
        } catch (const FileError& error) {
            frame = {};
            ++counters_.unreadable;
            if (reported_.insert(file).second && log_) log_(std::string("skipped: ") + error.what());
            continue;
        }
        any_this_round_ = true;
        file_ = file;
        return Outcome::captured;
    }
}

}  // namespace goalmouth
