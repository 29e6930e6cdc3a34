#include "tools/goalmouth/field_map.h"

#include "core/conversion/particles.h"
#include "core/conversion/pose.h"
#include "core/field/layout.h"
#include "tools/goalmouth/demo_monitor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string>

#include <Eigen/Eigenvalues>
#include <opencv2/imgproc.hpp>

namespace goalmouth {
namespace {

// BGR
const cv::Scalar paper(255, 255, 255);
const cv::Scalar ink(40, 40, 40);
const cv::Scalar carpet(96, 150, 86);
const cv::Scalar paint(240, 244, 240);
const cv::Scalar yellow(40, 210, 250);
const cv::Scalar truth_colour(150, 40, 20);
const cv::Scalar estimate_colour(20, 60, 230);
const cv::Scalar other_colour(170, 30, 150);
const cv::Scalar particle_colour(30, 40, 30);

constexpr double longest_step = 0.5;  // m between two poses of a path that are joined
constexpr int fraction_bits = 4;

/// The drawing area: where metres of the field lie in the picture.
class Canvas {
  public:
    Canvas(const FieldLayout& layout, int width)
        : unit_(width / 1280.0), half_x_(layout.carpet_half_length), half_y_(layout.carpet_half_width) {
        left_ = 60.0 * unit_;
        top_ = 24.0 * unit_;
        px_per_m_ = (width - left_ - 24.0 * unit_) / (2.0 * half_x_);
        const double height = top_ + 2.0 * half_y_ * px_per_m_ + 110.0 * unit_;
        picture_ = cv::Mat(static_cast<int>(std::ceil(height)), width, CV_8UC3, paper);
    }

    cv::Mat& picture() { return picture_; }
    double unit() const { return unit_; }
    double px_per_m() const { return px_per_m_; }
    double half_x() const { return half_x_; }
    double half_y() const { return half_y_; }
    int thick(double px) const { return std::max(1, static_cast<int>(std::lround(px * unit_))); }
    Eigen::Vector2d at(const Eigen::Vector2d& p) const {
        return {left_ + (p.x() + half_x_) * px_per_m_, top_ + (half_y_ - p.y()) * px_per_m_};
    }

    void line(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const cv::Scalar& colour, int thickness) {
        cv::line(picture_, fixed(at(a)), fixed(at(b)), colour, thickness, cv::LINE_AA, fraction_bits);
    }
    void polygon(const std::vector<Eigen::Vector2d>& corners, const cv::Scalar& colour) {
        std::vector<cv::Point> points;
        for (const Eigen::Vector2d& c : corners) points.push_back(fixed(at(c)));
        cv::fillConvexPoly(picture_, points, colour, cv::LINE_AA, fraction_bits);
    }
    void circle(const Eigen::Vector2d& centre, double radius_px, const cv::Scalar& colour, int thickness) {
        cv::circle(picture_, fixed(at(centre)),
                   static_cast<int>(std::lround(radius_px * (1 << fraction_bits))), colour, thickness,
                   cv::LINE_AA, fraction_bits);
    }
    /// `anchor`: 0 left, ½ middle, 1 right end of the text at x; y is its base line [px].
    int text(const std::string& words, double x, double y, double anchor, const cv::Scalar& colour = ink) {
        const double size = 0.5 * unit_;
        const cv::Size box = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, size, thick(1.0), nullptr);
        cv::putText(picture_, words, {static_cast<int>(x - anchor * box.width), static_cast<int>(y)},
                    cv::FONT_HERSHEY_SIMPLEX, size, colour, thick(1.0), cv::LINE_AA);
        return box.width;
    }

    static cv::Point fixed(const Eigen::Vector2d& p) {
        const auto coordinate = [](double v) {
            return static_cast<int>(std::lround(std::clamp(v, -1e5, 1e5) * (1 << fraction_bits)));
        };
        return {coordinate(p.x()), coordinate(p.y())};
    }

  private:
    double unit_;  // 1 for a picture 1280 px wide
    double half_x_;
    double half_y_;
    double left_;
    double top_;
    double px_per_m_;
    cv::Mat picture_;
};

void draw_ground(Canvas& canvas, const FieldLayout& ground) {
    const double x = ground.carpet_half_length;
    const double y = ground.carpet_half_width;
    canvas.polygon({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, carpet);
    for (const Stroke& s : ground.strokes) {
        const Eigen::Vector2d along = (s.to - s.from).normalized();
        const Eigen::Vector2d side = 0.5 * s.width * Eigen::Vector2d(-along.y(), along.x());
        canvas.polygon({s.from + side, s.to + side, s.to - side, s.from - side}, paint);
    }
    for (const Ring& r : ground.rings) {
        canvas.circle(r.centre, r.radius * canvas.px_per_m(), paint,
                      std::max(1, static_cast<int>(std::lround(r.width * canvas.px_per_m()))));
    }
}

void draw_goals(Canvas& canvas, const Field& field) {
    const cv::Scalar colour = field.goal_colour == "white" ? cv::Scalar(255, 255, 255) : yellow;
    const auto posts = field.posts();
    for (std::size_t goal = 0; goal < 2; ++goal) {
        const Eigen::Vector2d& left = posts[2 * goal];
        const Eigen::Vector2d& right = posts[2 * goal + 1];
        const Eigen::Vector2d back(goal == 0 ? -field.goal_depth : field.goal_depth, 0.0);
        canvas.line(left, left + back, paint, canvas.thick(1.5));
        canvas.line(left + back, right + back, paint, canvas.thick(1.5));
        canvas.line(right + back, right, paint, canvas.thick(1.5));
        canvas.line(left, right, colour, canvas.thick(4.0));
        for (const Eigen::Vector2d& post : {left, right}) {
            const double radius =
                std::max(5.0 * canvas.unit(), 0.5 * field.post_diameter * canvas.px_per_m());
            canvas.circle(post, radius, colour, cv::FILLED);
            canvas.circle(post, radius, ink, canvas.thick(1.0));
        }
    }
}

void draw_scale(Canvas& canvas) {
    const double x0 = canvas.at({-canvas.half_x(), 0}).x();
    const double y0 = canvas.at({0, -canvas.half_y()}).y();
    const double tick = 6.0 * canvas.unit();
    const auto mark = [&](double ax, double ay, double bx, double by) {
        cv::line(canvas.picture(), Canvas::fixed({ax, ay}), Canvas::fixed({bx, by}), ink, canvas.thick(1.0),
                 cv::LINE_AA, fraction_bits);
    };
    // So many metres from mark to mark that their numbers keep clear of each other.
    const int step = std::max(1, static_cast<int>(std::ceil(40.0 * canvas.unit() / canvas.px_per_m())));
    const int x_end = static_cast<int>(canvas.half_x()) / step * step;
    const int y_end = static_cast<int>(canvas.half_y()) / step * step;
    for (int m = -x_end; m <= x_end; m += step) {
        const double x = canvas.at({m, 0}).x();
        mark(x, y0, x, y0 + tick);
        const bool clear =
            x < canvas.at({canvas.half_x(), 0}).x() - 50.0 * canvas.unit();  // of the axis' name
        if (clear) canvas.text(fmt::format("{}", m), x, y0 + tick + 16.0 * canvas.unit(), 0.5);
    }
    for (int m = -y_end; m <= y_end; m += step) {
        const double y = canvas.at({0, m}).y();
        mark(x0 - tick, y, x0, y);
        const bool clear = y > canvas.at({0, canvas.half_y()}).y() + 24.0 * canvas.unit();
        if (clear) canvas.text(fmt::format("{}", m), x0 - 1.5 * tick, y + 5.0 * canvas.unit(), 1.0);
    }
    canvas.text("x [m]", canvas.at({canvas.half_x(), 0}).x(), y0 + tick + 16.0 * canvas.unit(), 1.0);
    canvas.text("y [m]", x0 - 1.5 * tick, canvas.at({0, canvas.half_y()}).y() + 10.0 * canvas.unit(), 1.0);
}

void draw_particles(Canvas& canvas, const Particles& particles) {
    const double length = 9.0 * canvas.unit() / canvas.px_per_m();
    for (const Particle& p : particles) {
        const Eigen::Vector2d heading(std::cos(p.pose.theta), std::sin(p.pose.theta));
        canvas.circle(p.pose.position(), 1.8 * canvas.unit(), particle_colour, cv::FILLED);
        canvas.line(p.pose.position(), p.pose.position() + length * heading, particle_colour, 1);
    }
}

void draw_path(Canvas& canvas, const std::vector<Pose2>& path, const cv::Scalar& colour, double px) {
    for (std::size_t i = 1; i < path.size(); ++i) {
        if ((path[i].position() - path[i - 1].position()).norm() > longest_step) continue;
        canvas.line(path[i - 1].position(), path[i].position(), colour, canvas.thick(px));
    }
    if (!path.empty()) canvas.circle(path.front().position(), 5.0 * canvas.unit(), colour, canvas.thick(2.0));
}

/// A robot: a disc with a nose.
void draw_robot(Canvas& canvas, const Pose2& pose, const cv::Scalar& colour) {
    const double length = 22.0 * canvas.unit() / canvas.px_per_m();
    const Eigen::Vector2d heading(std::cos(pose.theta), std::sin(pose.theta));
    const Eigen::Vector2d left(-heading.y(), heading.x());
    const Eigen::Vector2d p = pose.position();
    canvas.polygon({p + length * heading, p + 0.3 * length * left, p - 0.3 * length * left}, colour);
    canvas.circle(p, 6.5 * canvas.unit(), paper, cv::FILLED);
    canvas.circle(p, 5.0 * canvas.unit(), colour, cv::FILLED);
}

void draw_hypothesis(Canvas& canvas, const PoseHypothesis& hypothesis, const cv::Scalar& colour) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(hypothesis.covariance.topLeftCorner<2, 2>());
    std::vector<cv::Point> points;
    for (int i = 0; i < 72; ++i) {
        const double a = i * 2.0 * CV_PI / 72;
        const Eigen::Vector2d unit(std::cos(a), std::sin(a));
        const Eigen::Vector2d scaled = 2.0 * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().cwiseProduct(unit);
        points.push_back(Canvas::fixed(canvas.at(hypothesis.pose.position() + axes.eigenvectors() * scaled)));
    }
    cv::polylines(canvas.picture(), points, true, colour, canvas.thick(2.0), cv::LINE_AA, fraction_bits);
    draw_robot(canvas, hypothesis.pose, colour);
    const Eigen::Vector2d beside = canvas.at(hypothesis.pose.position());
    canvas.text(fmt::format("{:.0f} %", 100.0 * hypothesis.weight), beside.x() + 12.0 * canvas.unit(),
                beside.y() - 12.0 * canvas.unit(), 0.0, paper);
}

/// Entries from left to right under the field, going on in a second line where they do not fit.
class Legend {
  public:
    explicit Legend(Canvas& canvas) : canvas_(canvas) {
        x_ = start();
        y_ = canvas.at({0, -canvas.half_y()}).y() + 56.0 * canvas.unit();
    }

    void line(const cv::Scalar& colour, double px, const std::string& words) {
        const double width = 34.0 * canvas_.unit();
        make_room(words);
        cv::line(canvas_.picture(), Canvas::fixed({x_, middle()}), Canvas::fixed({x_ + width, middle()}),
                 colour, canvas_.thick(px), cv::LINE_AA, fraction_bits);
        write(words);
    }
    void ellipse(const cv::Scalar& colour, const std::string& words) {
        make_room(words);
        const double u = canvas_.unit();
        const cv::Point centre(static_cast<int>(x_ + 17.0 * u), static_cast<int>(middle()));
        cv::ellipse(canvas_.picture(), centre, cv::Size(canvas_.thick(16.0), canvas_.thick(8.0)), 0, 0, 360,
                    colour, canvas_.thick(2.0), cv::LINE_AA);
        cv::circle(canvas_.picture(), centre, canvas_.thick(4.0), colour, cv::FILLED, cv::LINE_AA);
        write(words);
    }
    void dots(const cv::Scalar& colour, const std::string& words) {
        make_room(words);
        for (const double dx : {6.0, 17.0, 28.0}) {
            cv::circle(canvas_.picture(),
                       {static_cast<int>(x_ + dx * canvas_.unit()), static_cast<int>(middle())},
                       canvas_.thick(2.0), colour, cv::FILLED, cv::LINE_AA);
        }
        write(words);
    }
    void words(const std::string& text) {
        make_room(text);
        x_ -= 42.0 * canvas_.unit();
        write(text);
    }

  private:
    double start() const { return canvas_.at({-canvas_.half_x(), 0}).x(); }
    double middle() const { return y_ - 5.0 * canvas_.unit(); }
    void make_room(const std::string& words) {
        const int width = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, 0.5 * canvas_.unit(),
                                          canvas_.thick(1.0), nullptr)
                              .width;
        if (x_ > start() && x_ + 42.0 * canvas_.unit() + width > canvas_.picture().cols - 8) {
            x_ = start();
            y_ += 26.0 * canvas_.unit();
        }
    }
    void write(const std::string& words) {
        x_ += 42.0 * canvas_.unit();
        x_ += canvas_.text(words, x_, y_, 0.0) + 28.0 * canvas_.unit();
    }

    Canvas& canvas_;
    double x_;
    double y_;
};

void draw_legend(Canvas& canvas, const Field& field, const FieldMap& map) {
    Legend legend(canvas);
    if (!map.true_path.empty()) legend.line(truth_colour, 3.0, "true path (o start)");
    if (!map.estimated_path.empty()) legend.line(estimate_colour, 2.0, "estimated path");
    if (!map.particles.empty())
        legend.dots(particle_colour, fmt::format("{} particles", map.particles.size()));
    if (map.pose) {
        legend.ellipse(estimate_colour, "pose, 2 sigma");
        if (map.pose->hypotheses.size() > 1) legend.ellipse(other_colour, "other hypotheses");
    }
    legend.words(fmt::format("{}: {:g} x {:g} m", field.name, field.length, field.width));
}

}  // namespace

cv::Mat draw_field_map(const Field& field, const FieldMap& map, int width) {
    const FieldLayout ground = layout(field);
    Canvas canvas(ground, std::max(400, width));
    draw_ground(canvas, ground);
    draw_goals(canvas, field);
    draw_scale(canvas);
    draw_particles(canvas, map.particles);
    draw_path(canvas, map.true_path, truth_colour, 3.0);
    draw_path(canvas, map.estimated_path, estimate_colour, 2.0);
    if (!map.true_path.empty()) draw_robot(canvas, map.true_path.back(), truth_colour);
    if (map.pose) {
        for (std::size_t i = map.pose->hypotheses.size(); i-- > 0;) {
            draw_hypothesis(canvas, map.pose->hypotheses[i], i == 0 ? estimate_colour : other_colour);
        }
    }
    draw_legend(canvas, field, map);
    return canvas.picture();
}

cv::Mat field_map_of(const Field& field, const DemoMonitor& monitor) {
    FieldMap map;
    map.true_path = monitor.true_path();
    map.estimated_path = monitor.estimated_path();
    if (monitor.pose()) map.pose = from_message(*monitor.pose());
    if (monitor.particles()) map.particles = from_message(*monitor.particles());
    return draw_field_map(field, map);
}

}  // namespace goalmouth
