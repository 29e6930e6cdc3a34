#include "core/simulation/sensor.h"

#include "core/imaging/yuyv.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using Light = std::function<Rgb(int, int)>;

YuyvImage expose(Sensor& sensor, const Intrinsics& camera, Random random, const Light& light,
                 const Rgb& gains = {1, 1, 1}) {
    YuyvImage image(camera.width, camera.height);
    sensor.begin(image.data.data(), image.stride(), gains, random);
    for (int y = 0; y < image.height; ++y) {
        const LightRow row = sensor.next_row();
        for (int x = 0; x < image.width; ++x) row.put(x, light(x, y));
        sensor.finish_row();
    }
    return image;
}

YuyvImage expose(const SensorParameters& parameters, const Intrinsics& camera, const Light& light,
                 const Rgb& gains = {1, 1, 1}) {
    Sensor sensor(parameters, RayTable(camera));
    return expose(sensor, camera, Random(1), light, gains);
}

YuyvImage expose(const SensorParameters& parameters, int width, int height, const Light& light) {
    return expose(parameters, from_horizontal_fov(width, height, 1.0), light);
}

Light uniform(Rgb colour) {
    return [colour](int, int) { return colour; };
}

TEST(Sensor, ColoursAreBt601FullRange) {
    const auto pixel = [](Rgb colour) {
        return expose({.blur = 0.0, .read_noise = 0.0}, 8, 4, [&](int, int) { return colour; })
            .view()
            .at(3, 2);
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
    EXPECT_EQ(pixel({0, 0, 255}).cb, 255);  // 255.5, which no byte holds
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

/// Variances and covariances of the bytes of a uniform light's frame; Y of the first pixel of each pair.
Eigen::Matrix3d covariance(const YuyvImage& image) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
    int n = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; x += 2, ++n) {
            const Ycbcr p = image.view().at(x, y);
            const Eigen::Vector3d v(p.y, p.cb, p.cr);
            mean += v;
            products += v * v.transpose();
        }
    mean /= n;
    return products / n - mean * mean.transpose();
}

TEST(Sensor, NoiseFollowsThePhotonTransferCurve) {
    const double read = 3.0;
    const double photon = 0.5;
    for (const Rgb& light : {Rgb{30, 30, 30}, Rgb{60, 90, 40}, Rgb{160, 120, 60}, Rgb{200, 180, 180}}) {
        const YuyvImage image =
            expose({.blur = 0.85, .read_noise = read, .photon_noise = photon}, 640, 480, uniform(light));
        const Eigen::Matrix3d seen = covariance(image);
        // Red, green and blue have noise of their own; a linear map takes it to Y, Cb, Cr, of which chroma is
        // the mean of two pixels and luma one of these two.
        Eigen::Matrix3d to_ycbcr;
        to_ycbcr << 0.299, 0.587, 0.114, -0.168736, -0.331264, 0.5, 0.5, -0.418688, -0.081312;
        const Eigen::Vector3d variance(read * read + photon * static_cast<double>(light.r),
                                       read * read + photon * static_cast<double>(light.g),
                                       read * read + photon * static_cast<double>(light.b));
        Eigen::Matrix3d expected = to_ycbcr * variance.asDiagonal() * to_ycbcr.transpose();
        expected.row(1) *= 0.5;
        expected.row(2) *= 0.5;
        expected(0, 1) = expected(1, 0);
        expected(0, 2) = expected(2, 0);
        expected.diagonal().array() += 1.0 / 12.0;  // rounding
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                EXPECT_NEAR(seen(i, j), expected(i, j), 0.02 * std::sqrt(expected(i, i) * expected(j, j)))
                    << "light " << static_cast<double>(light.r) << " " << i << j;
    }
}

TEST(Sensor, PhotonNoiseCountsTheLevelAfterTheGain) {
    const SensorParameters parameters{.blur = 0.0, .read_noise = 2.0, .photon_noise = 0.8};
    const Intrinsics camera = from_horizontal_fov(640, 480, 1.0);
    const auto sigma = [&](float light, float gain) {
        const YuyvImage image =
            expose(parameters, camera, uniform({light, light, light}), Rgb{gain, gain, gain});
        return moments(
                   image, [](Ycbcr p) { return p.y; }, 1)
            .sigma;
    };
    EXPECT_NEAR(sigma(50.0F, 2.0F), sigma(100.0F, 1.0F), 0.03);
    EXPECT_GT(sigma(50.0F, 2.0F), 1.2 * sigma(50.0F, 1.0F));
}

TEST(Sensor, GainsTintTheLight) {
    const YuyvImage image = expose({.blur = 0.85, .read_noise = 0.0}, from_horizontal_fov(16, 8, 1.0),
                                   uniform({100, 100, 100}), Rgb{1.5F, 1.0F, 0.5F});
    const Ycbcr p = image.view().at(7, 3);
    EXPECT_EQ(p.y, std::lround(0.299 * 150 + 0.587 * 100 + 0.114 * 50));
    EXPECT_EQ(p.cb, std::lround(128 - 0.168736 * 150 - 0.331264 * 100 + 0.5 * 50));
    EXPECT_EQ(p.cr, std::lround(128 + 0.5 * 150 - 0.418688 * 100 - 0.081312 * 50));
}

TEST(Sensor, VignettingIsAPowerOfTheCosine) {
    Intrinsics camera;  // off-centre and with a lens: the angle counts, not the pixel
    camera.cx = 300.0;
    camera.distortion = {-0.1, 0.02, 0.0, 0.0, 0.0};
    for (const double n : {2.0, 3.3, 4.0}) {
        const YuyvImage image =
            expose({.blur = 0.85, .vignetting = n, .read_noise = 0.0}, camera, uniform({220, 220, 220}));
        EXPECT_EQ(image.view().at(300, 239).y, 220);
        for (const double degrees : {5.0, 10.0, 20.0, 28.0})
            for (const double direction : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
                const double angle = degrees * std::numbers::pi / 180.0;
                const Eigen::Vector2d pixel = pixel_from_normalised(
                    camera, std::tan(angle) * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
                const int x = static_cast<int>(std::lround(pixel.x()));
                const int y = static_cast<int>(std::lround(pixel.y()));
                if (x < 4 || y < 4 || x > camera.width - 5 || y > camera.height - 5) continue;
                EXPECT_NEAR(image.view().at(x, y).y, 220.0 * std::pow(std::cos(angle), n), 1.0)
                    << degrees << " degrees, direction " << direction << ", power " << n;
            }
    }
}

TEST(Sensor, BrightYellowClipsToKnownLevels) {
    // Twice as much light as the post's colour takes: red and green stand at 255, blue goes on growing.
    const YuyvImage image = expose({.blur = 0.85, .read_noise = 0.0}, from_horizontal_fov(16, 8, 1.0),
                                   uniform({226, 184, 34}), Rgb{2, 2, 2});
    const Ycbcr p = image.view().at(8, 4);
    EXPECT_EQ(p.y, std::lround(0.299 * 255 + 0.587 * 255 + 0.114 * 68));
    EXPECT_EQ(p.cb, std::lround(128 - 0.168736 * 255 - 0.331264 * 255 + 0.5 * 68));
    EXPECT_EQ(p.cr, std::lround(128 + 0.5 * 255 - 0.418688 * 255 - 0.081312 * 68));
}

TEST(Sensor, NoiseClipsEachChannelBeforeTheyMix) {
    // Light at the upper bound: half of each channel's noise is cut off, so that its mean falls by σ/√(2π).
    const YuyvImage image = expose({.blur = 0.0, .read_noise = 20.0}, 640, 480, uniform({255, 255, 255}));
    const Moments y = moments(
        image, [](Ycbcr p) { return p.y; }, 1);
    EXPECT_NEAR(y.mean, 255.0 - 20.0 / std::sqrt(2.0 * std::numbers::pi), 0.1);
    // Variance of the cut noise is σ²(1/2 − 1/(2π)) a channel.
    const double one = 400.0 * (0.5 - 0.5 / std::numbers::pi);
    EXPECT_NEAR(y.sigma * y.sigma, one * (0.299 * 0.299 + 0.587 * 0.587 + 0.114 * 0.114) + 1.0 / 12.0, 1.0);
}

TEST(Sensor, ColoursBlurOnTheirOwn) {
    // Red ends where green begins: each is an error function, and chroma the pair's mean of what becomes of
    // them.
    const double sigma = 0.85;
    const YuyvImage image = expose({.blur = sigma, .read_noise = 0.0}, 40, 8, [](int x, int) {
        return x < 20 ? Rgb{200, 0, 0} : Rgb{0, 180, 0};
    });
    double weights = 0.0;
    for (int i = -3; i <= 3; ++i) weights += std::exp(-0.5 * i * i / (sigma * sigma));
    const auto right = [&](int x) {
        double share = 0.0;
        for (int i = -3; i <= 3; ++i)
            if (x + i >= 20) share += std::exp(-0.5 * i * i / (sigma * sigma)) / weights;
        return share;
    };
    for (int x = 10; x < 30; x += 2) {
        double cb = 0.0, cr = 0.0;
        for (const int k : {x, x + 1}) {
            const double red = 200.0 * (1.0 - right(k));
            const double green = 180.0 * right(k);
            EXPECT_NEAR(image.view().at(k, 4).y, 0.299 * red + 0.587 * green, 0.51) << k;
            cb += 0.5 * (-0.168736 * red - 0.331264 * green);
            cr += 0.5 * (0.5 * red - 0.418688 * green);
        }
        EXPECT_NEAR(image.view().at(x, 4).cb, 128.0 + cb, 0.51) << x;
        EXPECT_NEAR(image.view().at(x, 4).cr, 128.0 + cr, 0.51) << x;
    }
}

TEST(Sensor, FramesDifferByTheirRandomNumbersOnly) {
    const Intrinsics camera = from_horizontal_fov(64, 48, 1.0);
    Sensor sensor({.blur = 0.85, .read_noise = 6.0}, RayTable(camera));
    const auto grey = uniform({100, 100, 100});
    const auto one = expose(sensor, camera, Random(1), grey).data;
    const auto other = expose(sensor, camera, Random(2), grey).data;
    EXPECT_NE(one, other);
    EXPECT_EQ(one, expose(sensor, camera, Random(1), grey).data);
}

}  // namespace
}  // namespace goalmouth
