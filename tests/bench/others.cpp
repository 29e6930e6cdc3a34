#include "tests/bench/others.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <memory>

#include <opencv2/imgproc.hpp>
#ifdef GOALMOUTH_XIMGPROC
#include <opencv2/ximgproc/fast_line_detector.hpp>
#endif

namespace goalmouth::bench {
namespace {

/// Lengths and areas are given for pictures 640 px wide and grow with them.
double scale_of(const FrameSet& frames) {
    return frames.width() / 640.0;
}

/// OpenCV's way to look at somebody else's pixels, which it does not change.
cv::Mat yuyv_of(const FrameSet& frames, std::size_t item) {
    const YuyvView view = frames.view(item);
    return cv::Mat(view.height, view.width, CV_8UC2, const_cast<std::uint8_t*>(view.data),
                   static_cast<std::size_t>(view.stride));
}

struct HsvRange {
    const char* name;
    cv::Scalar lowest;  // hue 0…180, saturation, value 0…255
    cv::Scalar highest;
};
const HsvRange yellow{"yellow", {18, 90, 70}, {36, 255, 255}};
const HsvRange green{"green", {37, 60, 30}, {85, 255, 255}};
const HsvRange white{"white", {0, 0, 150}, {180, 50, 255}};

std::string words_of(const HsvRange& range) {
    return fmt::format("{} H {:g}…{:g} S {:g}…{:g} V {:g}…{:g}", range.name, range.lowest[0],
                       range.highest[0], range.lowest[1], range.highest[1], range.lowest[2],
                       range.highest[2]);
}

struct HsvContours {
    const FrameSet& frames;
    std::vector<HsvRange> ranges;
    bool open;
    double least_area;
    double straightness;
    cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    cv::Mat bgr = {};
    cv::Mat hsv = {};
    cv::Mat mask = {};
    cv::Mat opened = {};
    std::vector<std::vector<std::vector<cv::Point>>> contours = {};

    void run(std::size_t item) {
        cv::cvtColor(yuyv_of(frames, item), bgr, cv::COLOR_YUV2BGR_YUYV);
        cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
        contours.resize(ranges.size());
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            cv::inRange(hsv, ranges[i].lowest, ranges[i].highest, mask);
            if (open) cv::morphologyEx(mask, opened, cv::MORPH_OPEN, kernel);
            cv::findContours(open ? opened : mask, contours[i], cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
        }
    }
    Finding finding() const {
        Finding result;
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            for (const auto& contour : contours[i]) {
                if (cv::contourArea(contour) < least_area) continue;
                result.count += 1.0;
                if (i != 0) continue;  // goals come first
                std::vector<cv::Point> corners;
                cv::approxPolyDP(contour, corners, straightness, true);
                for (std::size_t c = 0; c < corners.size(); ++c) {
                    const cv::Point& a = corners[c];
                    const cv::Point& b = corners[(c + 1) % corners.size()];
                    result.edges.push_back({{static_cast<double>(a.x), static_cast<double>(a.y)},
                                            {static_cast<double>(b.x), static_cast<double>(b.y)}});
                }
            }
        }
        return result;
    }
};

template <class Lines>
Finding found_lines(const Lines& lines) {
    Finding result;
    result.count = static_cast<double>(lines.size());
    for (const auto& line : lines) {
        result.edges.push_back({{static_cast<double>(line[0]), static_cast<double>(line[1])},
                                {static_cast<double>(line[2]), static_cast<double>(line[3])}});
    }
    return result;
}

/// Gives the contender its work, an object with run(item) and finding().
template <class Work>
void give(Contender& contender, const std::shared_ptr<Work>& work) {
    contender.run = [work](std::size_t item, std::vector<double>&) { work->run(item); };
    contender.finding = [work] { return work->finding(); };
}

Contender contours_contender(const FrameSet& frames, std::vector<HsvRange> ranges, bool open) {
    const double least_area = 40.0 * scale_of(frames) * scale_of(frames);
    Contender contender;
    contender.settings = "YUYV→BGR→HSV";
    for (const HsvRange& range : ranges) contender.settings += "; " + words_of(range);
    contender.settings += open ? "; opening 3×3" : "";
    contender.settings += "; outer contours, simple chains";
    contender.finds = fmt::format("contours of {:.0f} px² or more", least_area);
    give(contender, std::make_shared<HsvContours>(
                        HsvContours{frames, std::move(ranges), open, least_area, 2.0 * scale_of(frames)}));
    return contender;
}

struct CannyHough {
    const FrameSet& frames;
    double low;
    double high;
    double scale;
    cv::Mat grey = {};
    cv::Mat edges = {};
    std::vector<cv::Vec4i> lines = {};

    int least_votes() const { return static_cast<int>(20.0 * scale); }
    double least_length() const { return 30.0 * scale; }
    double largest_gap() const { return 10.0 * scale; }

    void run(std::size_t item) {
        cv::cvtColor(yuyv_of(frames, item), grey, cv::COLOR_YUV2GRAY_YUYV);
        cv::Canny(grey, edges, low, high);
        cv::HoughLinesP(edges, lines, 1.0, CV_PI / 180.0, least_votes(), least_length(), largest_gap());
    }
    Finding finding() const { return found_lines(lines); }
};

Contender canny_hough_contender(const FrameSet& frames, double low, double high) {
    const auto work = std::make_shared<CannyHough>(CannyHough{frames, low, high, scale_of(frames)});
    Contender contender;
    contender.settings = fmt::format(
        "YUYV→grey; Canny {:g}/{:g}; HoughLinesP 1 px, 1°, {} votes, length ≥ {:g} px, gap ≤ {:g} px", low,
        high, work->least_votes(), work->least_length(), work->largest_gap());
    contender.finds = "lines";
    give(contender, work);
    return contender;
}

struct Lsd {
    const FrameSet& frames;
    cv::Ptr<cv::LineSegmentDetector> detector = cv::createLineSegmentDetector();
    cv::Mat grey = {};
    std::vector<cv::Vec4f> lines = {};

    void run(std::size_t item) {
        cv::cvtColor(yuyv_of(frames, item), grey, cv::COLOR_YUV2GRAY_YUYV);
        detector->detect(grey, lines);
    }
    Finding finding() const { return found_lines(lines); }
};

#ifdef GOALMOUTH_XIMGPROC
struct Fld {
    const FrameSet& frames;
    cv::Ptr<cv::ximgproc::FastLineDetector> detector = cv::ximgproc::createFastLineDetector();
    cv::Mat grey = {};
    std::vector<cv::Vec4f> lines = {};

    void run(std::size_t item) {
        cv::cvtColor(yuyv_of(frames, item), grey, cv::COLOR_YUV2GRAY_YUYV);
        detector->detect(grey, lines);
    }
    Finding finding() const { return found_lines(lines); }
};
#endif

}  // namespace

Contender hsv_contours(const FrameSet& frames) {
    Contender contender = contours_contender(frames, {yellow}, false);
    contender.name = "hsv";
    contender.label = "HSV + inRange + findContours";
    return contender;
}

Contender hsv_contours_of_three(const FrameSet& frames) {
    Contender contender = contours_contender(frames, {yellow, green, white}, true);
    contender.name = "hsv_three_colours";
    contender.label = "HSV, three colours, opened";
    return contender;
}

Contender canny_hough(const FrameSet& frames) {
    Contender contender = canny_hough_contender(frames, 50.0, 150.0);
    contender.name = "canny_hough";
    contender.label = "Canny + HoughLinesP";
    return contender;
}

Contender sensitive_canny_hough(const FrameSet& frames) {
    Contender contender = canny_hough_contender(frames, 30.0, 90.0);
    contender.name = "canny_hough_sensitive";
    contender.label = "Canny + HoughLinesP, fainter";
    return contender;
}

Contender line_segment_detector(const FrameSet& frames) {
    Contender contender;
    contender.name = "lsd";
    contender.label = "LSD";
    contender.settings = "YUYV→grey; cv::LineSegmentDetector as it comes";
    contender.finds = "lines";
    give(contender, std::make_shared<Lsd>(Lsd{frames}));
    return contender;
}

std::vector<Contender> fast_line_detector([[maybe_unused]] const FrameSet& frames) {
#ifdef GOALMOUTH_XIMGPROC
    Contender contender;
    contender.name = "fast_line_detector";
    contender.label = "FastLineDetector";
    contender.settings = "YUYV→grey; cv::ximgproc::FastLineDetector as it comes";
    contender.finds = "lines";
    give(contender, std::make_shared<Fld>(Fld{frames}));
    return {contender};
#else
    return {};
#endif
}

}  // namespace goalmouth::bench
