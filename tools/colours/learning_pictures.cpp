#include "tools/colours/learning_pictures.h"

#include "core/imaging/file_error.h"
#include "core/messaging/channels.h"
#include "core/messaging/image_input.h"
#include "core/messaging/log_bus.h"
#include "core/process/configuration.h"
#include "tools/goalmouth/picture_files.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <utility>

namespace goalmouth {

namespace {

namespace fs = std::filesystem;

/// Which of `all` things to keep for `most` evenly spread.
std::vector<bool> evenly(std::size_t all, std::size_t most) {
    std::vector<bool> kept(all, all <= most);
    for (std::size_t i = 0; all > most && i < most; ++i) kept[i * all / most] = true;
    return kept;
}

void each_frame(const std::string& log, const std::function<void(const Frame&)>& visit) {
    try {
        LogBus bus({.input = log, .output = {}});
        const ImageInput input(bus, "", channels::image_tap, channels::image_slices, visit);
        while (bus.dispatch(std::chrono::milliseconds(0))) {
        }
    } catch (const std::runtime_error& error) {
        throw ConfigurationError(log + ": cannot be read as an LCM log: " + error.what());
    }
}

std::size_t frames_in(const std::string& log) {
    std::size_t count = 0;
    each_frame(log, [&](const Frame&) { ++count; });
    if (count == 0) {
        throw ConfigurationError(log + ": holds no picture, neither on " + std::string(channels::image_tap) +
                                 " nor on " + channels::image_slices +
                                 "; it is neither an image file nor a log that a tap has put pictures into");
    }
    return count;
}

YuyvImage copy_of(YuyvView view) {
    YuyvImage image(view.width, view.height);
    for (int y = 0; y < view.height; ++y)
        std::copy_n(view.row(y), image.stride(), image.data.begin() + std::ptrdiff_t{y} * image.stride());
    return image;
}

struct Source {
    std::string file;
    bool is_log = false;
    std::size_t pictures = 1;
};

}  // namespace

NamedPicture picture_of_file(const fs::path& file, std::optional<ImageSize> size) {
    return {file.filename().string(), read_image(file, is_raw_image_name(file) ? size : std::nullopt), file,
            std::nullopt};
}

std::vector<NamedPicture> pictures_of_log(const fs::path& log, const std::set<std::size_t>& places) {
    std::vector<NamedPicture> pictures;
    std::size_t place = 0;
    each_frame(log.string(), [&](const Frame& frame) {
        if (places.contains(place))
            pictures.push_back({log.filename().string() + ", frame " + std::to_string(frame.seq),
                                copy_of(frame.pixels), log, place});
        ++place;
    });
    if (pictures.size() < places.size()) {
        throw ConfigurationError(log.string() + ": holds " + std::to_string(place) +
                                 " pictures, numbered from 0; there is no number " +
                                 std::to_string(*places.rbegin()));
    }
    return pictures;
}

bool is_log_file(const fs::path& file) {
    constexpr std::array<char, 4> sync_word = {'\xed', '\xa1', '\xda', '\x01'};
    std::array<char, 4> begins{};
    return std::ifstream(file, std::ios::binary).read(begins.data(), begins.size()) && begins == sync_word;
}

std::vector<NamedPicture> learning_pictures(const std::vector<std::string>& named,
                                            std::optional<ImageSize> size, std::size_t most) {
    std::vector<Source> sources;
    std::size_t all = 0;
    for (const std::string& file : picture_files(named)) {
        if (!fs::exists(file)) throw ConfigurationError(file + ": there is no such file or folder");
        Source source{file, !is_image_name(file), 1};
        if (source.is_log) source.pictures = frames_in(file);
        all += source.pictures;
        sources.push_back(source);
    }
    const std::vector<bool> wanted = evenly(all, most);
    std::vector<NamedPicture> pictures;
    std::size_t first = 0;
    for (const Source& source : sources) {
        if (source.is_log) {
            std::set<std::size_t> places;
            for (std::size_t i = 0; i < source.pictures; ++i)
                if (wanted[first + i]) places.insert(i);
            std::ranges::move(pictures_of_log(source.file, places), std::back_inserter(pictures));
        } else if (wanted[first]) {
            try {
                pictures.push_back(picture_of_file(source.file, size));
            } catch (const FileError& error) {
                throw ConfigurationError(error.what());
            }
        }
        first += source.pictures;
    }
    return pictures;
}

}  // namespace goalmouth
