#include "core/imaging/jpeg.h"
#include "core/messaging/typed.h"
#include "tests/support/example_messages.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

// Random bytes at every door that bytes come in by. Nothing here may crash, hang or take memory without
// bound; what is accepted must be valid. Seeds are fixed: a failure repeats.
namespace goalmouth {
namespace {

using namespace goalmouth::test;
using Bytes = std::vector<std::uint8_t>;

Bytes random_bytes(std::mt19937& random, std::size_t size) {
    Bytes bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    return bytes;
}

template <class Message>
void expect_harmless(const Bytes& bytes) {
    Message message{};
    if (!decode(bytes, message)) {
        EXPECT_EQ(encoded(message).size(), bytes.size());
    }
}

TEST(DecodeFuzz, RandomBytesAreNoMessage) {
    std::mt19937 random(1);
    for_each_example([&](const auto& example) {
        using Message = std::remove_cvref_t<decltype(example)>;
        for (int i = 0; i < 300; ++i) {
            Message message{};
            EXPECT_NE(decode(random_bytes(random, random() % 300), message), std::nullopt);
        }
    });
}

TEST(DecodeFuzz, RandomPayloadBehindTheRightHash) {
    std::mt19937 random(2);
    for_each_example([&](const auto& example) {
        using Message = std::remove_cvref_t<decltype(example)>;
        const Bytes valid = encoded(example);
        for (int i = 0; i < 1000; ++i) {
            Bytes bytes = random_bytes(random, 8 + random() % (2 * valid.size()));
            std::copy_n(valid.begin(), 8, bytes.begin());
            expect_harmless<Message>(bytes);
        }
    });
}

TEST(DecodeFuzz, ValidMessagesWithAFewBytesChanged) {
    std::mt19937 random(3);
    for_each_example([&](const auto& example) {
        using Message = std::remove_cvref_t<decltype(example)>;
        const Bytes valid = encoded(example);
        constexpr std::uint8_t telling[] = {0x00, 0x01, 0x7f, 0x80, 0xff};
        for (std::size_t at = 0; at < valid.size(); ++at) {
            for (const std::uint8_t value : telling) {
                Bytes bytes = valid;
                bytes[at] = value;
                expect_harmless<Message>(bytes);
            }
        }
        for (int i = 0; i < 3000; ++i) {
            Bytes bytes = valid;
            for (auto changes = 1 + random() % 4; changes > 0; --changes) {
                bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
            }
            expect_harmless<Message>(bytes);
        }
    });
}

TEST(DecodeFuzz, DamagedJpegs) {
    std::mt19937 random(4);
    YuyvImage image(33, 17);
    for (auto& byte : image.data) byte = static_cast<std::uint8_t>(random());
    const Bytes valid = jpeg_from_yuyv(image.view(), 80);
    const auto expect_survival = [](const Bytes& bytes) {
        try {
            const YuyvImage decoded = yuyv_from_jpeg(bytes);
            EXPECT_GT(decoded.width, 0);
        } catch (const std::runtime_error&) {
        }
    };
    for (std::size_t size = 0; size < valid.size(); ++size) {
        Bytes cut(valid.begin(), valid.begin() + static_cast<std::ptrdiff_t>(size));
        expect_survival(cut);
    }
    for (int i = 0; i < 2000; ++i) {
        Bytes bytes = valid;
        for (auto changes = 1 + random() % 8; changes > 0; --changes) {
            // The size in the header may ask for 16384×16384 pixels: valid, only slow.
            std::size_t at = random() % bytes.size();
            if (at > 155 && at < 170) at = 0;
            bytes[at] = static_cast<std::uint8_t>(random());
        }
        expect_survival(bytes);
    }
}

}  // namespace
}  // namespace goalmouth
