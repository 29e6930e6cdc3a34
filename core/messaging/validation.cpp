#include "core/messaging/validation.h"

#include "core/imaging/colour.h"
#include "core/imaging/colour_gains.h"
#include "core/imaging/yuyv.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

namespace goalmouth {
namespace {

using Problem = std::optional<std::string>;

// Edge points and hull vertices are pixels or transitions between pixels; their sub-pixel part is at
// most 1.28 px.
constexpr double image_margin_px = 2.0;
// Angles, unit quaternions and sums are held to their ranges up to what arithmetic in float or double costs.
constexpr double angle_slack = 1e-6;
constexpr double unit_slack = 1e-3;

bool finite(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

bool finite(double value) {
    return std::isfinite(value);
}

bool is_text(const std::string& s) {
    return s.find('\0') == std::string::npos;
}

template <class T>
bool holds(const std::vector<T>& column, std::int32_t rows) {
    return rows >= 0 && column.size() == static_cast<std::size_t>(rows);
}

bool is_angle(double value) {
    return std::abs(value) <= std::numbers::pi + angle_slack;  // false for NaN
}

bool is_unit(std::span<const double, 4> q) {
    return std::abs(std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) - 1.0) <= unit_slack;
}

/// Finite, symmetric, no correlation beyond ±1.
bool is_covariance(std::span<const double> c, std::size_t n) {
    if (!finite(c)) return false;
    for (std::size_t i = 0; i < n; ++i) {
        if (c[i * n + i] < 0.0) return false;
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const double scale = std::sqrt(c[i * n + i]) * std::sqrt(c[j * n + j]);
            const double slack = 1e-6 * scale + 1e-12;
            if (std::abs(c[i * n + j] - c[j * n + i]) > slack) return false;
            if (std::abs(c[i * n + j]) > scale + slack) return false;
        }
    }
    return true;
}

bool is_truth_value(std::int8_t value) {
    return value == 0 || value == 1;
}

/// Of unit length, or 0 for none.
bool is_normal(std::span<const double, 3> n) {
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return length == 0.0 || std::abs(length - 1.0) <= unit_slack;
}

bool is_none(std::span<const double, 3> n) {
    return n[0] == 0.0 && n[1] == 0.0 && n[2] == 0.0;
}

Problem frame_problem(std::int64_t utime, std::int64_t seq) {
    if (utime < 0) return "utime before 1970";
    if (seq < 0) return "negative seq";
    return {};
}

Problem points_problem(const std::vector<float>& x, const std::vector<float>& y, const intrinsics_t& image) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double px = x[i];
        const double py = y[i];
        if (!finite(px) || !finite(py)) return "a point that is not finite";
        if (px < -image_margin_px || px > image.width - 1 + image_margin_px || py < -image_margin_px ||
            py > image.height - 1 + image_margin_px) {
            return "a point outside the image";
        }
    }
    return {};
}

/// Number of pixels along scan-lines of this orientation, and of such lines.
struct Extent {
    int along = 0;
    int lines = 0;
    bool holds(int line, int start, int end) const {
        return line >= 0 && line < lines && start >= 0 && end < along;
    }
};
Extent extent_of(std::int8_t orientation, const intrinsics_t& image) {
    return orientation == 0 ? Extent{image.width, image.height} : Extent{image.height, image.width};
}

}  // namespace

Problem problem(const intrinsics_t& m) {
    if (m.width < 1 || m.width > 16384 || m.height < 1 || m.height > 16384) return "impossible image size";
    if (!finite(m.fx) || !finite(m.fy) || m.fx <= 0.0 || m.fy <= 0.0) return "impossible focal length";
    if (!finite(m.cx) || !finite(m.cy)) return "impossible principal point";
    if (!finite(m.distortion)) return "impossible distortion";
    return {};
}

Problem problem(const camera_info_t& m) {
    if (m.utime < 0) return "utime before 1970";
    if (!is_text(m.camera) || !is_text(m.source)) return "a name with zero bytes";
    if (!finite(m.frames_per_second) || m.frames_per_second < 0.0) return "impossible frame rate";
    return problem(m.intrinsics);
}

Problem problem(const image_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (auto cause = problem(m.intrinsics)) return cause;
    if (m.width != m.intrinsics.width || m.height != m.intrinsics.height)
        return "size differs from the calibration's";
    if (!is_text(m.camera) || !is_text(m.encoding) || !is_text(m.ring)) return "a name with zero bytes";
    if (m.exposure_us < 0 || m.readout_us < 0) return "negative exposure or readout time";
    if (m.encoding == "yuyv") {
        if (m.row_stride < yuyv_row_bytes(m.width)) return "rows shorter than the image";
        const std::int64_t least =
            std::int64_t{m.row_stride} * (m.height - 1) + std::int64_t{yuyv_row_bytes(m.width)};
        const std::int64_t most = std::int64_t{m.row_stride} * m.height;
        if (m.size < least || m.size > most) return "pixel data of another size than the image";
    } else if (m.encoding == "jpeg") {
        if (m.row_stride != 0) return "a row stride of compressed data";
        if (m.size < 1) return "no pixel data";
    } else {
        return "unknown encoding";
    }
    if (!holds(m.data, m.data_size)) return "sizes that disagree";
    if (m.ring.empty()) {
        if (m.data_size != m.size) return "self-contained, but without its pixels";
        if (m.slot != -1 || m.generation != -1) return "self-contained, but with a slot";
    } else {
        if (m.data_size != 0) return "a descriptor with pixels";
        if (m.slot < 0 || m.generation < 0) return "a descriptor without a slot";
    }
    return {};
}

Problem problem(const image_slice_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (!is_text(m.camera)) return "a name with zero bytes";
    if (m.slices < 1 || m.slice < 0 || m.slice >= m.slices) return "impossible slice number";
    if (!holds(m.data, m.data_size) || m.data_size < 1) return "sizes that disagree";
    if (m.offset < 0 || m.total_size < 1 || m.data_size > m.total_size ||
        m.offset > m.total_size - m.data_size) {
        return "a slice outside its image";
    }
    if (m.slices > m.total_size) return "more slices than bytes";
    if ((m.slice == 0) != (m.offset == 0)) return "a slice that starts elsewhere";
    if ((m.slice == m.slices - 1) != (m.offset == m.total_size - m.data_size))
        return "a slice that ends elsewhere";
    return {};
}

Problem problem(const segments_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (auto cause = problem(m.intrinsics)) return cause;
    if (!is_text(m.table)) return "a name with zero bytes";
    if (m.lines_left_out < 0) return "a negative number of lines left out";
    if (!holds(m.line_orientation, m.num_lines) || !holds(m.line_position, m.num_lines) ||
        !holds(m.line_count, m.num_lines) || !holds(m.start, m.num_segments) ||
        !holds(m.end, m.num_segments) || !holds(m.colour, m.num_segments) ||
        !holds(m.transition_offset, m.num_segments)) {
        return "sizes that disagree";
    }
    std::size_t next = 0;
    for (std::size_t line = 0; line < m.line_count.size(); ++line) {
        if (m.line_orientation[line] != 0 && m.line_orientation[line] != 1) return "unknown orientation";
        const Extent extent = extent_of(m.line_orientation[line], m.intrinsics);
        if (m.line_position[line] < 0 || m.line_position[line] >= extent.lines)
            return "a line outside the image";
        if (m.line_count[line] < 1) return "a line without segments";
        const std::size_t stop = next + static_cast<std::size_t>(m.line_count[line]);
        if (stop > m.start.size()) return "lines that claim more segments than there are";
        int expected_start = 0;
        for (; next < stop; ++next) {
            if (m.start[next] != expected_start) return "segments that are not contiguous";
            if (m.end[next] < m.start[next]) return "a segment that ends before it starts";
            if (m.colour[next] < 0 || m.colour[next] >= colour_count) return "unknown colour";
            expected_start = m.end[next] + 1;
        }
        if (expected_start != extent.along) return "segments that do not cover their line";
    }
    if (next != m.start.size()) return "segments without a line";
    return {};
}

Problem problem(const border_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (auto cause = problem(m.intrinsics)) return cause;
    if (!holds(m.hull_x, m.num_hull) || !holds(m.hull_y, m.num_hull) || !holds(m.point_x, m.num_points) ||
        !holds(m.point_y, m.num_points)) {
        return "sizes that disagree";
    }
    if (auto cause = points_problem(m.hull_x, m.hull_y, m.intrinsics)) return cause;
    if (auto cause = points_problem(m.point_x, m.point_y, m.intrinsics)) return cause;
    if (!std::is_sorted(m.hull_x.begin(), m.hull_x.end()))
        return "a hull that does not run from left to right";
    return {};
}

Problem problem(const colour_gains_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    constexpr std::int64_t longest_lead = 60'000'000;  // µs
    if (m.from_utime < m.utime) return "gains that hold before the frame they follow from";
    if (m.from_utime - m.utime > longest_lead) return "gains that hold long after the frame they follow from";
    for (const double gain : {m.red, m.green, m.blue})
        if (!finite(gain) || gain < least_gain || gain > largest_gain) return "an impossible gain";
    for (const auto& colour : {std::span(m.field), std::span(m.goal)})
        for (const double level : colour)
            if (!finite(level) || level < 0.0 || level > 255.0) return "a colour beyond 0…255";
    return {};
}

Problem problem(const candidates_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (auto cause = problem(m.intrinsics)) return cause;
    if (!holds(m.orientation, m.num_segments) || !holds(m.line, m.num_segments) ||
        !holds(m.start, m.num_segments) || !holds(m.end, m.num_segments) ||
        !holds(m.field_line, m.num_field) || !holds(m.field_start, m.num_field) ||
        !holds(m.field_end, m.num_field) || !holds(m.left_x, m.num_left) || !holds(m.left_y, m.num_left) ||
        !holds(m.right_x, m.num_right) || !holds(m.right_y, m.num_right)) {
        return "sizes that disagree";
    }
    for (std::size_t i = 0; i < m.line.size(); ++i) {
        if (m.orientation[i] != 0 && m.orientation[i] != 1) return "unknown orientation";
        const Extent extent = extent_of(m.orientation[i], m.intrinsics);
        if (m.end[i] < m.start[i]) return "a segment that ends before it starts";
        if (!extent.holds(m.line[i], m.start[i], m.end[i])) return "a segment outside the image";
    }
    const Extent rows = extent_of(0, m.intrinsics);
    for (std::size_t i = 0; i < m.field_line.size(); ++i) {
        if (m.field_end[i] < m.field_start[i]) return "a stretch of field that ends before it starts";
        if (!rows.holds(m.field_line[i], m.field_start[i], m.field_end[i]))
            return "a stretch of field outside the image";
    }
    if (auto cause = points_problem(m.left_x, m.left_y, m.intrinsics)) return cause;
    return points_problem(m.right_x, m.right_y, m.intrinsics);
}

Problem problem(const post_t& m) {
    if (!finite(m.left_top) || !finite(m.left_base) || !finite(m.right_top) || !finite(m.right_base)) {
        return "a post whose corners are not finite";
    }
    constexpr std::int32_t all_flags = 2 * post_t::REFINED - 1;  // the last and all before it
    if ((m.flags & ~all_flags) != 0) return "a post with unknown flags";
    if (m.side < post_t::SIDE_UNKNOWN || m.side > post_t::SIDE_RIGHT) return "a post with an unknown side";
    if (!finite(m.width_px) || m.width_px <= 0.0) return "a post of impossible width";
    if (!finite(m.distance_m)) return "a post at an impossible distance";
    if ((m.flags & post_t::NO_DISTANCE) != 0 ? m.distance_m != 0.0 : m.distance_m <= 0.0) {
        return "a post at an impossible distance";
    }
    if (!(std::abs(m.bearing_rad) <= std::numbers::pi / 2 + angle_slack))
        return "a post at an impossible bearing";
    if (!is_covariance(m.covariance, 2)) return "a post with an impossible covariance";
    if (m.support_left < 0 || m.support_right < 0) return "a post with negative support";
    return {};
}

Problem problem(const posts_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (auto cause = problem(m.intrinsics)) return cause;
    if (!is_text(m.detector)) return "a name with zero bytes";
    if (!holds(m.posts, m.num_posts)) return "sizes that disagree";
    for (const post_t& post : m.posts) {
        if (auto cause = problem(post)) return cause;
    }
    return {};
}

Problem problem(const distance_cue_t& m) {
    if (m.kind < distance_cue_t::WIDTH || m.kind > distance_cue_t::GOAL) return "an unknown distance cue";
    if (!finite(m.distance_m) || m.distance_m <= 0.0) return "a distance cue at an impossible distance";
    if (!finite(m.sigma_m) || m.sigma_m < 0.0) return "a distance cue of impossible sigma";
    return {};
}

Problem problem(const refined_post_t& m) {
    if (!is_truth_value(m.refined) || !is_truth_value(m.base_seen) || !is_truth_value(m.top_seen))
        return "neither true nor false";
    if (!is_text(m.reason)) return "a reason with zero bytes";
    if (m.refined != 0 && !m.reason.empty()) return "a refined post with a reason why not";
    if (!(m.quality >= 0.0 && m.quality <= 1.0)) return "impossible quality";
    if (m.rows < 0 || m.iterations < 0) return "a negative count";
    if (m.rows_left < 0 || m.rows_left > m.rows || m.rows_right < 0 || m.rows_right > m.rows)
        return "an impossible number of rows";
    if (!finite(m.left_plane) || !is_normal(m.left_plane) || !finite(m.right_plane) ||
        !is_normal(m.right_plane)) {
        return "a plane whose normal is not of unit length";
    }
    if ((is_none(m.left_plane) && m.rows_left != 0) || (is_none(m.right_plane) && m.rows_right != 0))
        return "rows of an edge that was not measured";
    if (m.refined != 0 && is_none(m.left_plane) && is_none(m.right_plane))
        return "a refined post without an edge";
    if (!finite(m.base) || !finite(m.top)) return "a point that is not finite";
    if (!holds(m.cues, m.num_cues)) return "sizes that disagree";
    for (const distance_cue_t& cue : m.cues) {
        if (auto cause = problem(cue)) return cause;
    }
    return {};
}

Problem problem(const refinement_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (!holds(m.posts, m.num_posts)) return "sizes that disagree";
    for (const refined_post_t& post : m.posts) {
        if (auto cause = problem(post)) return cause;
    }
    return {};
}

Problem problem(const odometry_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (!finite(m.x) || !finite(m.y) || !finite(m.theta)) return "a pose that is not finite";
    for (const double noise : {m.translation_noise, m.rotation_noise}) {
        if (!finite(noise) || (noise < 0.0 && noise != -1.0)) return "impossible noise";
    }
    return {};
}

Problem problem(const kinematics_t& m) {
    if (m.utime < 0) return "utime before 1970";
    if (m.seq < -1) return "negative seq";
    if (!finite(m.translation)) return "a position that is not finite";
    if (!finite(m.quaternion) || !is_unit(m.quaternion)) return "a quaternion that is not of unit length";
    if (!is_covariance(m.covariance, 6)) return "impossible covariance";
    return {};
}

Problem problem(const pose_hypothesis_t& m) {
    if (!(m.weight >= 0.0 && m.weight <= 1.0 + angle_slack)) return "a hypothesis of impossible weight";
    if (!finite(m.x) || !finite(m.y) || !is_angle(m.theta)) return "an impossible hypothesis";
    if (!is_covariance(m.covariance, 3)) return "a hypothesis with an impossible covariance";
    return {};
}

Problem problem(const pose_t& m) {
    if (m.utime < 0) return "utime before 1970";
    if (m.seq < -1) return "negative seq";
    if (!finite(m.x) || !finite(m.y) || !is_angle(m.theta)) return "an impossible pose";
    if (!is_covariance(m.covariance, 3)) return "impossible covariance";
    const double size = m.effective_sample_size;
    if (!finite(size) || (size != 0.0 && size < 1.0 - angle_slack)) return "impossible effective sample size";
    if (m.posts_used < 0 || m.posts_rejected < 0) return "a negative number of posts";
    if (!holds(m.hypotheses, m.num_hypotheses)) return "sizes that disagree";
    if (m.hypotheses.empty()) return "no hypothesis";
    double sum = 0.0;
    for (const pose_hypothesis_t& hypothesis : m.hypotheses) {
        if (auto cause = problem(hypothesis)) return cause;
        if (hypothesis.weight > m.hypotheses.front().weight)
            return "hypotheses that do not start with the heaviest";
        sum += hypothesis.weight;
    }
    if (sum > 1.0 + unit_slack) return "hypotheses that weigh more than the belief";
    return {};
}

Problem problem(const particles_t& m) {
    if (m.utime < 0) return "utime before 1970";
    if (m.seq < -1) return "negative seq";
    if (!holds(m.x, m.num_particles) || !holds(m.y, m.num_particles) || !holds(m.theta, m.num_particles) ||
        !holds(m.weight, m.num_particles)) {
        return "sizes that disagree";
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < m.x.size(); ++i) {
        if (!finite(m.x[i]) || !finite(m.y[i]) || !finite(m.theta[i])) return "a particle that is not finite";
        if (!(m.weight[i] >= 0.0F)) return "a particle of impossible weight";
        sum += m.weight[i];
    }
    if (!m.x.empty() && !(std::abs(sum - 1.0) <= unit_slack)) return "weights that do not add up to 1";
    return {};
}

Problem problem(const truth_t& m) {
    if (auto cause = frame_problem(m.utime, m.seq)) return cause;
    if (!finite(m.x) || !finite(m.y) || !finite(m.theta)) return "a pose that is not finite";
    if (!finite(m.camera_translation)) return "a position that is not finite";
    if (!finite(m.camera_quaternion) || !is_unit(m.camera_quaternion))
        return "a quaternion that is not of unit length";
    if (!finite(m.ball_x) || !finite(m.ball_y)) return "a ball that is not finite";
    if (!holds(m.posts, m.num_posts)) return "sizes that disagree";
    for (const truth_post_t& post : m.posts) {
        if (post.id < 0 || post.id > 3) return "a post with an unknown id";
        if (!finite(post.x) || !finite(post.y)) return "a post that is not finite";
        if (!finite(post.distance_m) || post.distance_m < 0.0) return "a post at an impossible distance";
        if (!is_angle(post.bearing_rad)) return "a post at an impossible bearing";
        if (!finite(post.left_top) || !finite(post.left_base) || !finite(post.right_top) ||
            !finite(post.right_base)) {
            return "a post whose corners are not finite";
        }
        if (!(post.visible >= 0.0 && post.visible <= 1.0)) return "a post of impossible visibility";
    }
    return {};
}

Problem problem(const status_t& m) {
    if (m.utime < 0) return "utime before 1970";
    if (!is_text(m.process) || !is_text(m.executable)) return "a name with zero bytes";
    if (m.pid < 0) return "a negative pid";
    if (m.state < status_t::STARTING || m.state > status_t::STOPPED) return "unknown state";
    if (m.received < 0 || m.published < 0 || m.dropped < 0 || m.rejected < 0) return "a negative count";
    if (!finite(m.rate) || m.rate < 0.0) return "impossible rate";
    for (const double latency : {m.latency_p50, m.latency_p99}) {
        if (!finite(latency) || (latency < 0.0 && latency != -1.0)) return "impossible latency";
    }
    if (!finite(m.busy) || m.busy < 0.0) return "impossible load";
    if (!holds(m.counters, m.num_counters)) return "sizes that disagree";
    for (const counter_t& counter : m.counters) {
        if (!is_text(counter.name)) return "a name with zero bytes";
        if (!finite(counter.value)) return "a counter that is not finite";
    }
    return {};
}

}  // namespace goalmouth
