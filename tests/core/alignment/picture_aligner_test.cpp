#include "core/alignment/picture_aligner.h"

#include <algorithm>
#include <random>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

constexpr std::int64_t frame_us = 33'333;

FrameMark mark(std::int64_t seq) {
    return {1'000'000'000 + seq * frame_us, seq};
}

/// A camera that tells by its height which sample it was.
KinematicsSample kinematics(std::int64_t utime) {
    KinematicsSample sample{utime, {}};
    sample.camera.T_BC.translation().z() = 1e-6 * static_cast<double>(utime);
    return sample;
}
KinematicsSample kinematics_of(std::int64_t seq) {
    return kinematics(mark(seq).utime);
}

struct Found {
    FrameMark frame;
    bool wants_picture = true;
};
struct Picture {
    FrameMark frame;
};
using Event = std::variant<Found, Picture, KinematicsSample>;

std::int64_t time_of(const Event& event) {
    if (const auto* found = std::get_if<Found>(&event)) return found->frame.utime;
    if (const auto* picture = std::get_if<Picture>(&event)) return picture->frame.utime;
    return std::get<KinematicsSample>(event).utime;
}

/// Runs events through an aligner of its own.
struct Replay {
    explicit Replay(PictureTimingParameters parameters = {}) : aligner(parameters) {}

    std::vector<PictureAligner::Aligned> add(const Event& event) {
        std::vector<PictureAligner::Aligned> now;
        if (const auto* found = std::get_if<Found>(&event)) {
            now = aligner.add_frame(found->frame, found->wants_picture);
        } else if (const auto* picture = std::get_if<Picture>(&event)) {
            now = aligner.add_picture(picture->frame);
        } else {
            now = aligner.add(std::get<KinematicsSample>(event));
        }
        all.insert(all.end(), now.begin(), now.end());
        return now;
    }
    void add_all(const std::vector<Event>& events) {
        for (const Event& event : events) add(event);
    }
    std::vector<std::int64_t> seqs() const {
        std::vector<std::int64_t> numbers;
        for (const auto& aligned : all) numbers.push_back(aligned.frame.seq);
        return numbers;
    }

    PictureAligner aligner;
    std::vector<PictureAligner::Aligned> all;
};

TEST(PictureAligner, LeavesAtOnceWithPictureAndKinematics) {
    Replay run;
    run.add(kinematics_of(0));
    run.add(Picture{mark(0)});
    const auto left = run.add(Found{mark(0)});
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].frame, mark(0));
    EXPECT_TRUE(left[0].has_picture);
    ASSERT_TRUE(left[0].camera);
    EXPECT_EQ(left[0].camera->T_BC.translation().z(), kinematics_of(0).camera.T_BC.translation().z());
}

TEST(PictureAligner, WaitsForAPictureThatComesLater) {
    Replay run;
    run.add(kinematics_of(0));
    EXPECT_TRUE(run.add(Found{mark(0)}).empty());
    EXPECT_TRUE(run.add(kinematics_of(1)).empty());
    EXPECT_TRUE(run.add(Picture{mark(1)}).empty()) << "another frame's";
    const auto left = run.add(Picture{mark(0)});
    ASSERT_EQ(left.size(), 1U);
    EXPECT_TRUE(left[0].has_picture);
}

TEST(PictureAligner, WaitsForKinematicsAtOrAfterTheFrame) {
    Replay run;
    run.add(kinematics(mark(0).utime - 10'000));
    run.add(Picture{mark(0)});
    EXPECT_TRUE(run.add(Found{mark(0)}).empty());
    const auto left = run.add(kinematics(mark(0).utime + 10'000));
    ASSERT_EQ(left.size(), 1U);
    ASSERT_TRUE(left[0].camera);
    EXPECT_NEAR(left[0].camera->T_BC.translation().z(), 1e-6 * static_cast<double>(mark(0).utime), 1e-9)
        << "interpolated";
}

TEST(PictureAligner, GivesUpOnceDataIsNewerByTheWait) {
    Replay run;
    run.add(kinematics_of(0));
    run.add(Picture{mark(0)});
    run.add(Found{mark(0)});
    EXPECT_TRUE(run.add(Found{mark(1)}).empty());
    EXPECT_TRUE(run.add(kinematics(mark(1).utime + 199'999)).empty());
    const auto left = run.add(kinematics(mark(1).utime + 200'001));
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].frame, mark(1));
    EXPECT_FALSE(left[0].has_picture);
}

TEST(PictureAligner, NothingToLookAtNeedsNoPicture) {
    Replay run;
    EXPECT_EQ(run.add(Found{mark(0), false}).size(), 1U);
    EXPECT_TRUE(run.add(Found{mark(1), true}).empty());
    EXPECT_TRUE(run.add(Found{mark(2), false}).empty()) << "the order stays";
    run.add(kinematics_of(1));
    EXPECT_EQ(run.add(Picture{mark(1)}).size(), 2U);
    EXPECT_EQ(run.seqs(), (std::vector<std::int64_t>{0, 1, 2}));
}

TEST(PictureAligner, WithoutPicturesFramesLeaveAtOnceAfterAStart) {
    Replay run;
    for (int i = 0; i < 60; ++i) {
        run.add(kinematics_of(i));
        const auto left = run.add(Found{mark(i)});
        if (i > 15) {
            ASSERT_EQ(left.size(), 1U) << i;
            EXPECT_EQ(left[0].frame, mark(i));
            EXPECT_FALSE(left[0].has_picture);
        }
    }
    EXPECT_EQ(run.all.size(), 60U);
}

TEST(PictureAligner, WithoutKinematicsFramesLeaveAtOnceAfterAStart) {
    Replay run;
    for (int i = 0; i < 60; ++i) {
        run.add(Picture{mark(i)});
        const auto left = run.add(Found{mark(i)});
        if (i > 15) {
            ASSERT_EQ(left.size(), 1U) << i;
            EXPECT_TRUE(left[0].has_picture);
            EXPECT_FALSE(left[0].camera);
        }
    }
    EXPECT_EQ(run.all.size(), 60U);
}

TEST(PictureAligner, WithoutAWaitWhatCameBeforeCounts) {
    PictureTimingParameters parameters;
    parameters.wait = 0.0;
    Replay run(parameters);
    auto left = run.add(Found{mark(0)});
    ASSERT_EQ(left.size(), 1U);
    EXPECT_FALSE(left[0].has_picture);
    run.add(kinematics_of(1));
    run.add(Picture{mark(1)});
    left = run.add(Found{mark(1)});
    ASSERT_EQ(left.size(), 1U);
    EXPECT_TRUE(left[0].has_picture);
    EXPECT_TRUE(left[0].camera);
}

TEST(PictureAligner, SilentPicturesAreWaitedForNoLonger) {
    Replay run;
    for (int i = 0; i < 100; ++i) {
        run.add(kinematics_of(i));
        if (i < 20) run.add(Picture{mark(i)});
        const auto left = run.add(Found{mark(i)});
        if (i < 20 || i > 60) {
            EXPECT_EQ(left.size(), 1U) << i;
        }
    }
    EXPECT_EQ(run.all.size(), 100U);
    run.add(Picture{mark(100)});
    run.add(kinematics_of(100));
    EXPECT_TRUE(run.add(Found{mark(100)})[0].has_picture) << "they came back";
}

TEST(PictureAligner, PicturesOfSeveralCamerasComeInAnyOrder) {
    Replay run;
    const FrameMark other{mark(0).utime + 5'000, 700};
    run.add(kinematics(other.utime));
    run.add(Picture{other});
    run.add(Picture{mark(0)});
    EXPECT_TRUE(run.add(Found{mark(0)})[0].has_picture);
    EXPECT_TRUE(run.add(Found{other})[0].has_picture);
}

TEST(PictureAligner, AReplayThatBeginsAgainAnswersWhatWaited) {
    Replay run;
    for (int i = 100; i < 120; ++i) {
        run.add(kinematics_of(i));
        run.add(Picture{mark(i)});
        run.add(Found{mark(i)});
    }
    EXPECT_TRUE(run.add(Found{mark(120)}).empty());
    // Posts first, then their picture, then kinematics: the old time's kinematics do not count as come.
    auto left = run.add(Found{mark(0)});
    ASSERT_EQ(left.size(), 1U);
    EXPECT_EQ(left[0].frame, mark(120));
    EXPECT_TRUE(run.add(Picture{mark(0)}).empty());
    left = run.add(kinematics_of(0));
    ASSERT_EQ(left.size(), 1U);
    EXPECT_TRUE(left[0].has_picture);
    EXPECT_EQ(left[0].camera->T_BC.translation().z(), kinematics_of(0).camera.T_BC.translation().z());
    EXPECT_EQ(run.all.size(), 22U);
}

TEST(PictureAligner, KinematicsThatComeTwiceOrLateAreCounted) {
    Replay run;
    run.add(kinematics_of(3));
    run.add(kinematics_of(3));
    run.add(kinematics_of(2));
    EXPECT_EQ(run.aligner.out_of_order(), 2);
}

TEST(PictureAligner, FlushAnswersAll) {
    Replay run;
    run.add(Found{mark(0)});
    run.add(Found{mark(1)});
    const auto left = run.aligner.flush();
    ASSERT_EQ(left.size(), 2U);
    EXPECT_EQ(left[1].frame, mark(1));
    EXPECT_TRUE(run.aligner.flush().empty());
}

/// Three channels, each in its own order, merged at random with less than the wait between them.
std::vector<Event> interleaved(const std::vector<Event>& events, std::mt19937& random) {
    std::uniform_real_distribution<double> delay(0.0, 150'000.0);
    std::vector<std::pair<double, Event>> arrivals;
    double last[3] = {};
    for (const Event& event : events) {
        double at = static_cast<double>(time_of(event)) + delay(random);
        at = std::max(at, last[event.index()] + 0.5);
        last[event.index()] = at;
        arrivals.emplace_back(at, event);
    }
    std::stable_sort(arrivals.begin(), arrivals.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Event> merged;
    for (const auto& [at, event] : arrivals) merged.push_back(event);
    return merged;
}

/// Two seconds with lost pictures, frames without posts, and kinematics at times of their own.
std::vector<Event> eventful(int pictures_every) {
    std::vector<Event> events;
    for (int i = 0; i < 60; ++i) {
        events.push_back(kinematics(mark(i).utime - 7'000));
        if (i % pictures_every == 0 && i % 7 != 3) events.push_back(Picture{mark(i)});
        if (i % 11 != 5) events.push_back(Found{mark(i), i % 5 != 4});
    }
    std::stable_sort(events.begin(), events.end(),
                     [](const Event& a, const Event& b) { return time_of(a) < time_of(b); });
    return events;
}

TEST(PictureAligner, WhatLeavesDoesNotDependOnTheInterleaving) {
    std::mt19937 random(5);
    for (const int pictures_every : {1, 2, 15, 1000}) {
        const std::vector<Event> events = eventful(pictures_every);
        Replay in_order;
        in_order.add_all(events);
        const auto rest = in_order.aligner.flush();
        in_order.all.insert(in_order.all.end(), rest.begin(), rest.end());
        for (int trial = 0; trial < 200; ++trial) {
            Replay run;
            run.add_all(interleaved(events, random));
            const auto tail = run.aligner.flush();
            run.all.insert(run.all.end(), tail.begin(), tail.end());
            ASSERT_EQ(run.seqs(), in_order.seqs());
            for (std::size_t i = 0; i < run.all.size(); ++i) {
                const auto& a = run.all[i];
                const auto& b = in_order.all[i];
                if (a.frame.seq % 5 == 4) continue;  // nobody looks at it
                ASSERT_EQ(a.has_picture, b.has_picture) << "every " << pictures_every << ", " << i;
                if (!a.has_picture) continue;
                ASSERT_EQ(a.camera.has_value(), b.camera.has_value()) << i;
                if (a.camera) {
                    ASSERT_EQ(a.camera->T_BC.translation(), b.camera->T_BC.translation()) << i;
                }
            }
        }
    }
}

}  // namespace
}  // namespace goalmouth
