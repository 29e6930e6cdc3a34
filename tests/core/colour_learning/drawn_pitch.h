#pragma once

#include "core/imaging/colour.h"
#include "core/imaging/conversion.h"
#include "core/imaging/yuyv.h"

#include <array>
#include <cstdint>
#include <vector>

#include <opencv2/imgproc.hpp>

// Pictures of a pitch of which each pixel's class is known.
namespace goalmouth::test {

/// As a lamp and a camera's exposure scale red, green and blue.
struct Light {
    double red = 1.0;
    double green = 1.0;
    double blue = 1.0;
};

struct DrawnPitch {
    cv::Vec3d goal{40, 190, 225};  // BGR under Light{}
    cv::Vec3d wall{150, 158, 160};
    bool ball = true;
    bool posts = true;
    bool lines = true;
    bool field = true;
    int things = 6;  // on the wall
    Light light = {};
};

struct DrawnPicture {
    YuyvImage image;
    cv::Mat truth;                // CV_8UC1: Colour of each pixel
    std::vector<cv::Rect> posts;  // from the crossbar's lower side to the foot
};

/// Picture number `n`: posts, ball, line and clutter stand elsewhere in each. A wall with things in orange,
/// in blue and in the posts' own colour, which hang above the field and are no posts; the camera blurs and is
/// noisy.
inline DrawnPicture draw_pitch(const DrawnPitch& pitch, unsigned n) {
    cv::RNG random(n + 1);
    const cv::Size size(640, 480);
    cv::Mat bgr(size, CV_64FC3, cv::Scalar(pitch.wall[0], pitch.wall[1], pitch.wall[2]));
    cv::Mat truth(size, CV_8UC1, cv::Scalar(0));
    std::vector<cv::Rect> posts;
    const auto fill = [&](const cv::Rect& box, const cv::Vec3d& colour, Colour c) {
        cv::rectangle(bgr, box, cv::Scalar(colour[0], colour[1], colour[2]), cv::FILLED);
        cv::rectangle(truth, box, cv::Scalar(static_cast<int>(c)), cv::FILLED);
    };
    const int border = 150 + random.uniform(-15, 16);
    for (int i = 0; i < pitch.things; ++i) {
        const std::array<cv::Vec3d, 4> colours = {cv::Vec3d{30, 90, 170}, cv::Vec3d{160, 80, 40},
                                                  cv::Vec3d{30, 30, 34}, pitch.goal};
        fill({random.uniform(0, 560), random.uniform(0, border - 70), random.uniform(20, 80),
              random.uniform(10, 35)},
             colours[static_cast<std::size_t>(random.uniform(0, 4))], Colour::unclassified);
    }
    if (pitch.field) {
        fill({0, border, 640, 480 - border}, {60, 120, 45}, Colour::field);
        // The carpet is worn and lit unevenly.
        for (int y = border; y < 480; ++y)
            for (int x = 0; x < 640; ++x) bgr.at<cv::Vec3d>(y, x) *= 0.85 + 0.3 * x / 640.0;
    }
    const cv::Vec3d paint{228, 230, 230};
    if (pitch.lines) {
        fill({0, border + 14, 640, 5}, paint, Colour::line);
        fill({random.uniform(40, 560), border + 19, 14, 480}, paint, Colour::line);
    }
    if (pitch.posts) {
        const int width = random.uniform(16, 30);
        const int left = random.uniform(20, 200);
        const int right = left + random.uniform(150, 380);
        for (const int x : {left, right}) {
            posts.emplace_back(x, 20, width, border);
            fill(posts.back(), pitch.goal, Colour::goal);
            for (int y = 20; y < border + 20; ++y)
                for (int i = 0; i < width; ++i) {  // round: darker towards its sides
                    const double across = 2.0 * (i + 0.5) / width - 1.0;
                    bgr.at<cv::Vec3d>(y, x + i) *= 1.0 - 0.35 * across * across;
                }
        }
        fill({left, 12, right - left + width, width}, pitch.goal, Colour::goal);
    }
    if (pitch.ball) {
        const cv::Point centre(random.uniform(60, 580), random.uniform(border + 60, 440));
        cv::circle(bgr, centre, 16, cv::Scalar(25, 95, 230), cv::FILLED);
        cv::circle(truth, centre, 16, cv::Scalar(static_cast<int>(Colour::ball)), cv::FILLED);
    }
    cv::GaussianBlur(bgr, bgr, {0, 0}, 0.8);
    cv::Mat noise(size, CV_64FC3);
    random.fill(noise, cv::RNG::NORMAL, 0, 5);
    cv::multiply(bgr, cv::Scalar(pitch.light.blue, pitch.light.green, pitch.light.red), bgr);
    bgr += noise;
    cv::Mat shown;
    bgr.convertTo(shown, CV_8UC3);
    return {yuyv_from_bgr(shown), truth, posts};
}

}  // namespace goalmouth::test
