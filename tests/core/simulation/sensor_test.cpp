#include "core/simulation/sensor.h"

#include "core/imaging/yuyv.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

YuyvImage expose(Sensor& sensor, int width, int height, Random random,
                 const std::function<Rgb(int, int)>& light) {
    YuyvImage image(width, height);
    sensor.begin(image.data.data(), image.stride(), random);
    for (int y = 0; y < height; ++y) {
        const LightRow row = sensor.next_row();
        for (int x = 0; x < width; ++x) row.put(x, light(x, y));
        sensor.finish_row();
    }
    return image;
}

YuyvImage expose(const SensorParameters& parameters, int width, int height,
                 const std::function<Rgb(int, int)>& light) {
    Sensor sensor(parameters, width, height);
    return expose(sensor, width, height, Random(1), light);
}

TEST(Sensor, ColoursAreBt601FullRange) {
    const auto pixel = [](Rgb colour) {
        return expose({.blur = 0.0, .read_noise = 0.0}, 8, 4, [&](int, int) { return colour; }).view().at(3, 2);
    };
    const Ycbcr red = pixel({255, 0, 0});
    EXPECT_EQ(red.y, 76);
    EXPECT_EQ(red.cb, 85);
    EXPECT_EQ(red.cr, 255);
    const Ycbcr green = pixel({0, 255, 0});
    EXPECT_EQ(green.y, 150);
    EXPECT_EQ(green.cb, 44);
    EXPECT_EQ(green.cr, 21);
    const Ycbcr grey = pixel({93, 93, 93});
    EXPECT_EQ(grey.y, 93);
    EXPECT_EQ(grey.cb, 128);
    EXPECT_EQ(grey.cr, 128);
    EXPECT_EQ(pixel({400, 400, 400}).y, 255);
    EXPECT_EQ(pixel({-9, -9, -9}).y, 0);
}

TEST(Sensor, ChromaIsTheMeanOfAPair) {
    const YuyvImage image = expose({.blur = 0.0, .read_noise = 0.0}, 8, 2, [](int x, int) {
        return x % 2 == 0 ? Rgb{200, 0, 0} : Rgb{0, 0, 200};
    });
    const Ycbcr left = image.view().at(4, 1);
    const Ycbcr right = image.view().at(5, 1);
    EXPECT_EQ(left.cb, right.cb);
    EXPECT_EQ(left.cb, std::lround(128 + 0.5 * (-0.168736 * 200 + 0.5 * 200)));
    EXPECT_EQ(left.cr, std::lround(128 + 0.5 * (0.5 * 200 - 0.081312 * 200)));
    EXPECT_NE(left.y, right.y);
}

TEST(Sensor, BlurTurnsAStepIntoAnErrorFunction) {
    for (const double sigma : {0.5, 0.85, 1.7})
        for (const bool upright : {true, false}) {
            const YuyvImage image = expose({.blur = sigma, .read_noise = 0.0}, 40, 40, [&](int x, int y) {
                const float level = (upright ? x : y) < 20 ? 20.0F : 220.0F;
                return Rgb{level, level, level};
            });
            // A sampled Gaussian: its sum up to pixel k, which the integral up to k + 1/2 comes close to.
            double weights = 0.0;
            for (int i = -20; i <= 20; ++i) weights += std::exp(-0.5 * i * i / (sigma * sigma));
            for (int k = 10; k < 30; ++k) {
                double share = 0.0;
                for (int i = -20; i <= k - 20; ++i)
                    share += std::exp(-0.5 * i * i / (sigma * sigma)) / weights;
                const int y = upright ? image.view().at(k, 17).y : image.view().at(17, k).y;
                EXPECT_NEAR(y, 20.0 + 200.0 * share, 1.0) << sigma << " " << k;
            }
        }
}

TEST(Sensor, BlurDoesNotMoveChroma) {
    // A red bar, symmetric about the middle of a pair.
    const YuyvImage image = expose({.blur = 0.85, .read_noise = 0.0}, 64, 8, [](int x, int) {
        return x >= 28 && x <= 33 ? Rgb{200, 30, 30} : Rgb{30, 30, 30};
    });
    for (int i = 1; i <= 12; ++i)
        EXPECT_EQ(image.view().at(30 - 2 * i, 4).cr, image.view().at(30 + 2 * i, 4).cr) << i;
    EXPECT_GT(image.view().at(30, 4).cr, image.view().at(26, 4).cr);
}

TEST(Sensor, UniformLightStaysUniformToTheRim) {
    const YuyvImage image = expose({.blur = 1.3, .read_noise = 0.0}, 31, 9, [](int, int) {
        return Rgb{90, 150, 40};
    });
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 31; ++x) {
            ASSERT_EQ(image.view().at(x, y).y, image.view().at(0, 0).y);
            ASSERT_EQ(image.view().at(x, y).cb, image.view().at(0, 0).cb);
            ASSERT_EQ(image.view().at(x, y).cr, image.view().at(0, 0).cr);
        }
}

TEST(Sensor, ImagesSmallerThanTheBlurWork) {
    for (const int size : {1, 2, 3}) {
        const YuyvImage image = expose({.blur = 2.0, .read_noise = 0.0}, size, size, [](int, int) {
            return Rgb{50, 50, 50};
        });
        EXPECT_EQ(image.view().at(size - 1, size - 1).y, 50);
    }
}

struct Moments {
    double mean = 0.0, sigma = 0.0;
};
Moments moments(const YuyvImage& image, const std::function<double(Ycbcr)>& channel, int step) {
    double sum = 0.0, squares = 0.0;
    int n = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; x += step) {
            const double v = channel(image.view().at(x, y));
            sum += v;
            squares += v * v;
            ++n;
        }
    const double mean = sum / n;
    return {mean, std::sqrt(squares / n - mean * mean)};
}

TEST(Sensor, NoiseHasTheSigmaOfRedGreenAndBlue) {
    const YuyvImage image = expose({.blur = 0.85, .read_noise = 6.0}, 640, 480, [](int, int) {
        return Rgb{100, 120, 90};
    });
    const double rounding = 1.0 / 12.0;
    const auto expected = [&](double r, double g, double b, int pixels) {
        return std::sqrt(36.0 * (r * r + g * g + b * b) / pixels + rounding);
    };
    const Moments y = moments(
        image, [](Ycbcr p) { return p.y; }, 1);
    const Moments cb = moments(
        image, [](Ycbcr p) { return p.cb; }, 2);
    const Moments cr = moments(
        image, [](Ycbcr p) { return p.cr; }, 2);
    EXPECT_NEAR(y.sigma, expected(0.299, 0.587, 0.114, 1), 0.05);
    EXPECT_NEAR(cb.sigma, expected(0.168736, 0.331264, 0.5, 2), 0.05);
    EXPECT_NEAR(cr.sigma, expected(0.5, 0.418688, 0.081312, 2), 0.05);
    EXPECT_NEAR(y.mean, 0.299 * 100 + 0.587 * 120 + 0.114 * 90, 0.05);
}

TEST(Sensor, NoiseOfNeighboursIsIndependent) {
    const YuyvImage image = expose({.blur = 0.85, .read_noise = 6.0}, 640, 480, [](int, int) {
        return Rgb{100, 100, 100};
    });
    double along = 0.0, down = 0.0, self = 0.0;
    for (int y = 0; y < 479; ++y)
        for (int x = 0; x < 639; ++x) {
            const double here = image.view().at(x, y).y - 100.0;
            self += here * here;
            along += here * (image.view().at(x + 1, y).y - 100.0);
            down += here * (image.view().at(x, y + 1).y - 100.0);
        }
    EXPECT_NEAR(along / self, 0.0, 0.02);
    EXPECT_NEAR(down / self, 0.0, 0.02);
}

TEST(Sensor, FramesDifferByTheirRandomNumbersOnly) {
    Sensor sensor({.blur = 0.85, .read_noise = 6.0}, 64, 48);
    const auto grey = [](int, int) { return Rgb{100, 100, 100}; };
    const auto one = expose(sensor, 64, 48, Random(1), grey).data;
    const auto other = expose(sensor, 64, 48, Random(2), grey).data;
    EXPECT_NE(one, other);
    EXPECT_EQ(one, expose(sensor, 64, 48, Random(1), grey).data);
}

}  // namespace
}  // namespace goalmouth
