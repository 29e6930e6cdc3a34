#include "core/messaging/log_bus.h"
#include "core/messaging/typed.h"
#include "tests/support/data.h"
#include "tests/support/example_messages.h"

#include <csignal>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <vector>

#include <gtest/gtest.h>
#include <lcm/lcm-cpp.hpp>

namespace goalmouth {
namespace {

using namespace goalmouth::test;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// `count` odometry messages, one each millisecond.
fs::path make_log(const fs::path& path, int count) {
    LogBus bus({"", path});
    auto message = example_odometry();
    for (message.seq = 0; message.seq < count; ++message.seq) {
        bus.set_time(1'000'000 + 1000 * message.seq);
        publish(bus, "ODOMETRY", message);
    }
    return path;
}

std::vector<std::int64_t> seqs_of(const fs::path& path) {
    std::vector<std::int64_t> seqs;
    LogBus bus({path, ""});
    subscribe<odometry_t>(bus, "ODOMETRY", [&](const odometry_t& m) { seqs.push_back(m.seq); });
    while (bus.dispatch(0ms)) {
    }
    EXPECT_TRUE(bus.finished());
    return seqs;
}

TEST(Log, LcmReadsWhatWeWrite) {
    const TemporaryFolder folder;
    const fs::path path = make_log(folder.path() / "log", 5);
    lcm::LogFile log(path, "r");
    ASSERT_TRUE(log.good());
    for (int i = 0; i < 5; ++i) {
        const lcm::LogEvent* event = log.readNextEvent();
        ASSERT_NE(event, nullptr);
        EXPECT_EQ(event->eventnum, i);
        EXPECT_EQ(event->timestamp, 1'000'000 + 1000 * i);
        EXPECT_EQ(event->channel, "ODOMETRY");
        odometry_t back{};
        const auto* bytes = static_cast<const std::uint8_t*>(event->data);
        ASSERT_EQ(decode({bytes, static_cast<std::size_t>(event->datalen)}, back), std::nullopt);
        EXPECT_EQ(back.seq, i);
    }
    EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST(Log, ReadsRealLogsAsLcmDoes) {
    GOALMOUTH_NEEDS_DATA(data);
    int logs = 0;
    int backwards = 0;
    for (const auto& entry : fs::recursive_directory_iterator(data / "lcm_logs")) {
        if (entry.path().extension() != ".lcmlog") continue;
        ++logs;
        lcm::LogFile reference(entry.path(), "r");
        ASSERT_TRUE(reference.good());
        LogReader reader(entry.path());
        std::int64_t last = 0;
        std::size_t events = 0;
        while (const lcm::LogEvent* expected = reference.readNextEvent()) {
            const auto event = reader.next();
            ASSERT_TRUE(event.has_value()) << entry.path() << " event " << events;
            ASSERT_EQ(event->number, expected->eventnum);
            ASSERT_EQ(event->utime, expected->timestamp);
            ASSERT_EQ(event->channel, expected->channel);
            ASSERT_EQ(event->data.size(), static_cast<std::size_t>(expected->datalen));
            ASSERT_EQ(std::memcmp(event->data.data(), expected->data, event->data.size()), 0);
            backwards += event->utime < last ? 1 : 0;
            last = event->utime;
            ++events;
        }
        EXPECT_GT(events, 0U) << entry.path();
    }
    EXPECT_GT(logs, 0);
    RecordProperty("logs", logs);
    RecordProperty("events_backwards_in_time", backwards);
}

TEST(Log, ForeignMessagesOfRealLogsAreRefusedNotBelieved) {
    GOALMOUTH_NEEDS_DATA(data);
    std::int64_t refused = 0;
    for (const auto& entry : fs::recursive_directory_iterator(data / "lcm_logs")) {
        if (entry.path().extension() != ".lcmlog") continue;
        LogBus bus({entry.path(), ""});
        std::map<std::string, int> channels;
        for (const auto& event : read_log(entry.path())) ++channels[event.channel];
        for (const auto& [channel, count] : channels) {
            subscribe<odometry_t>(bus, channel,
                                  [](const odometry_t&) { FAIL() << "a robot of another house"; });
            subscribe<pose_t>(bus, channel, [](const pose_t&) { FAIL() << "a robot of another house"; });
        }
        while (bus.dispatch(0ms)) {
        }
        EXPECT_EQ(bus.counters().rejected_total(), bus.counters().received);
        refused += bus.counters().rejected_total();
    }
    EXPECT_GT(refused, 0);
}

TEST(Log, ALogCutAnywhereInItsLastTwoEventsLosesOnlyThem) {
    const TemporaryFolder folder;
    const std::string whole = contents(make_log(folder.path() / "whole", 6));
    ASSERT_EQ(whole.size() % 6, 0U);
    const std::size_t event = whole.size() / 6;
    for (std::size_t size = 4 * event; size <= whole.size(); ++size) {
        const fs::path cut = folder.path() / "cut";
        write_file(cut, whole.substr(0, size));
        ASSERT_EQ(seqs_of(cut).size(), size / event) << size;
        LogReader reader(cut);
        while (reader.next()) {
        }
        ASSERT_EQ(reader.damaged_stretches(), size % event == 0 ? 0 : 1) << size;
    }
}

TEST(Log, GarbageBetweenEventsCostsNoEvent) {
    const TemporaryFolder folder;
    const std::string whole = contents(make_log(folder.path() / "whole", 6));
    const std::size_t event = whole.size() / 6;
    std::mt19937 random(6);
    for (int round = 0; round < 50; ++round) {
        std::string damaged;
        for (std::size_t i = 0; i < 6; ++i) {
            for (auto bytes = random() % 500; bytes > 0; --bytes) damaged += static_cast<char>(random());
            if (round % 2 == 1)
                damaged += "\xED\xA1\xDA\x01";  // garbage that looks like the start of an event
            damaged += whole.substr(i * event, event);
        }
        write_file(folder.path() / "damaged", damaged);
        EXPECT_EQ(seqs_of(folder.path() / "damaged"), (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5}));
    }
}

TEST(Log, AnyChangedByteCostsAtMostItsOwnEvent) {
    const TemporaryFolder folder;
    const std::string whole = contents(make_log(folder.path() / "whole", 5));
    const std::size_t event = whole.size() / 5;
    for (std::size_t at = 2 * event; at < 3 * event; ++at) {
        for (const char value : {'\x00', '\x01', '\x7f', '\xff'}) {
            std::string damaged = whole;
            damaged[at] = value;
            write_file(folder.path() / "damaged", damaged);
            const auto events = read_log(folder.path() / "damaged");
            std::vector<std::int64_t> numbers;
            for (const auto& e : events) {
                if (e.channel == "ODOMETRY" && e.data.size() == encoded(example_odometry()).size())
                    numbers.push_back(e.utime);
            }
            for (const std::int64_t expected : {1'000'000, 1'001'000, 1'003'000, 1'004'000}) {
                EXPECT_EQ(std::count(numbers.begin(), numbers.end(), expected), 1) << at << " " << int{value};
            }
        }
    }
}

TEST(Log, RandomBytesHoldNoEventAndEnd) {
    const TemporaryFolder folder;
    std::mt19937 random(7);
    for (const std::size_t size : {0UL, 1UL, 27UL, 28UL, 1000UL, 300'000UL}) {
        std::string bytes(size, '\0');
        for (auto& byte : bytes) byte = static_cast<char>(random());
        write_file(folder.path() / "random", bytes);
        EXPECT_TRUE(read_log(folder.path() / "random").empty()) << size;
    }
    std::string starts;
    for (int i = 0; i < 100'000; ++i) starts += "\xED\xA1\xDA\x01";
    write_file(folder.path() / "starts", starts);
    EXPECT_TRUE(read_log(folder.path() / "starts").empty());
}

TEST(Log, AMissingFileIsAnErrorThatNamesIt) {
    const TemporaryFolder folder;
    for (const fs::path& path : {folder.path() / "missing.lcmlog", folder.path()}) {
        try {
            LogBus bus({path, ""});
            FAIL();
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
        }
    }
    EXPECT_THROW(LogBus({"", folder.path() / "no" / "folder"}), std::runtime_error);
}

TEST(Log, AFullDiskIsAnError) {
    if (!fs::exists("/dev/full")) GTEST_SKIP() << "skipped: no /dev/full";
    LogBus bus({"", "/dev/full"});
    EXPECT_THROW(publish(bus, "ODOMETRY", example_odometry()), std::runtime_error);
}

TEST(Log, OneThatKeepsWhatThereIsTakesTheNextNameThatIsFree) {
    const TemporaryFolder folder;
    const fs::path path = folder.path() / "log";
    std::ofstream(path) << "mine";
    fs::create_symlink(folder.path() / "not_there", path.string() + ".2");  // a name that is taken as well
    LogWriter writer(path, LogWriter::Existing::keep);
    EXPECT_EQ(writer.path(), path.string() + ".3");
    writer.write("A", 1, std::vector<std::uint8_t>{1});
    EXPECT_EQ(read_log(writer.path()).size(), 1U);
    EXPECT_EQ(contents(path), "mine");
    EXPECT_FALSE(fs::exists(folder.path() / "not_there"));
    EXPECT_THROW(LogWriter(folder.path() / "no" / "such", LogWriter::Existing::keep), std::runtime_error);
}

TEST(Log, WhatADiskRefusesInTheMiddleOfAnEventIsTakenBack) {
    const TemporaryFolder folder;
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    const fs::path path = folder.path() / "log";
    {
        LogWriter writer(path);
        writer.write("A", 1, std::vector<std::uint8_t>(1000, 1));
        rlimit small = before;
        small.rlim_cur = 1500;
        setrlimit(RLIMIT_FSIZE, &small);
        EXPECT_THROW(writer.write("B", 2, std::vector<std::uint8_t>(1000, 2)), std::runtime_error);
        setrlimit(RLIMIT_FSIZE, &before);
        writer.write("C", 3, std::vector<std::uint8_t>(1000, 3));
    }
    std::signal(SIGXFSZ, old_handler);
    LogReader reader(path);
    EXPECT_EQ(reader.next()->channel, "A");
    const auto second = reader.next();
    ASSERT_TRUE(second.has_value());
    EXPECT_EQ(second->channel, "C");
    EXPECT_EQ(second->number, 1);
    EXPECT_FALSE(reader.next().has_value());
    EXPECT_EQ(reader.damaged_stretches(), 0);
}

TEST(Log, OneLogInAnotherLogOutKeepsTheTimesOfTheInput) {
    const TemporaryFolder folder;
    make_log(folder.path() / "in", 4);
    {
        LogBus bus({folder.path() / "in", folder.path() / "out"});
        subscribe<odometry_t>(bus, "ODOMETRY", [&](const odometry_t& m) { publish(bus, "AGAIN", m); });
        while (!bus.finished()) bus.dispatch(0ms);
    }
    const auto events = read_log(folder.path() / "out");
    ASSERT_EQ(events.size(), 4U);
    EXPECT_EQ(events[3].channel, "AGAIN");
    EXPECT_EQ(events[3].utime, 1'003'000);
    EXPECT_THROW(LogBus({folder.path() / "in", folder.path() / "in"}), std::runtime_error);
}

TEST(Log, WhoHearsAllHearsEachEventOfALog) {
    const TemporaryFolder folder;
    make_log(folder.path() / "in", 4);
    LogBus bus({folder.path() / "in", {}});
    std::vector<std::vector<std::uint8_t>> heard;
    int odometry = 0;
    bus.subscribe_all(
        [&](const std::string&, auto bytes) { heard.emplace_back(bytes.begin(), bytes.end()); });
    bus.subscribe("ODOMETRY", Delivery::every, [&](auto) { ++odometry; });
    while (!bus.finished()) bus.dispatch(0ms);
    const auto events = read_log(folder.path() / "in");
    ASSERT_EQ(heard.size(), events.size());
    for (std::size_t i = 0; i < heard.size(); ++i) EXPECT_EQ(heard[i], events[i].data);
    EXPECT_EQ(odometry, 4);
}

}  // namespace
}  // namespace goalmouth
