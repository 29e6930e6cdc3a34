#include "tools/colours/marked_pictures.h"

#include "core/imaging/file_error.h"
#include "core/process/configuration.h"

#include <fmt/format.h>
#include <map>
#include <set>
#include <system_error>
#include <utility>

namespace goalmouth {

namespace {

namespace fs = std::filesystem;

/// The same for all names of a picture.
using Identity = std::pair<fs::path, std::optional<std::size_t>>;

Identity identity(const fs::path& file, std::optional<std::size_t> place) {
    std::error_code problem;
    const fs::path canonical = fs::weakly_canonical(file, problem);
    return {problem ? file : canonical, place};
}

std::vector<NamedPicture> load(const fs::path& file, const std::set<std::optional<std::size_t>>& places,
                               std::optional<ImageSize> size) {
    std::vector<NamedPicture> pictures;
    std::set<std::size_t> in_log;
    for (const auto& place : places) {
        if (place) {
            in_log.insert(*place);
        } else {
            pictures.push_back(picture_of_file(file, size));
        }
    }
    if (!in_log.empty())
        for (NamedPicture& picture : pictures_of_log(file, in_log)) pictures.push_back(std::move(picture));
    return pictures;
}

}  // namespace

void add_marks(MarkedPictures& to, const std::vector<MarkLine>& lines, const fs::path& file,
               std::optional<ImageSize> size) {
    const auto error = [&](int line, const std::string& what) {
        return ConfigurationError(fmt::format("{}:{}: {}", file.string(), line, what));
    };
    std::map<Identity, std::size_t> known;
    for (std::size_t i = 0; i < to.pictures.size(); ++i)
        known.emplace(identity(to.pictures[i].file, to.pictures[i].place), i);

    // All that is wanted of a log at once: it is read from its beginning.
    std::map<fs::path, std::set<std::optional<std::size_t>>> wanted;
    for (const MarkLine& line : lines)
        if (!known.contains(identity(line.picture.file, line.picture.place)))
            wanted[line.picture.file].insert(line.picture.place);

    for (const MarkLine& line : lines) {
        const Identity which = identity(line.picture.file, line.picture.place);
        if (!known.contains(which)) {
            try {
                for (NamedPicture& picture : load(line.picture.file, wanted[line.picture.file], size)) {
                    known.emplace(identity(picture.file, picture.place), to.pictures.size());
                    to.pictures.push_back(std::move(picture));
                }
            } catch (const FileError& problem) {
                throw error(line.line, problem.what());
            } catch (const ConfigurationError& problem) {
                throw error(line.line, problem.what());
            }
        }
        const std::size_t i = known.at(which);
        const YuyvImage& image = to.pictures[i].image;
        const std::string problem = shape_problem(line.shape, {image.width, image.height});
        if (!problem.empty()) throw error(line.line, problem);
        to.marks.push_back({i, line.colour, line.shape});
    }
}

std::vector<MarkLine> lines_of(const std::vector<ColourMark>& marks,
                               const std::vector<NamedPicture>& pictures) {
    std::vector<MarkLine> lines;
    for (const ColourMark& mark : marks) {
        const NamedPicture& picture = pictures[mark.picture];
        lines.push_back({{picture.file, picture.place}, mark.colour, mark.shape, 0});
    }
    return lines;
}

}  // namespace goalmouth
