#include "core/messaging/encoded_form.h"

#include "core/messaging/typed.h"
#include "tests/support/example_messages.h"

#include <gtest/gtest.h>

namespace goalmouth {
namespace {

using namespace goalmouth::test;

TEST(EncodedForm, LengthsOfEveryEncodedExampleAddUp) {
    for_each_example([](const auto& message) {
        EXPECT_TRUE(lengths_add_up(message, encoded(message))) << message.getTypeName();
    });
}

TEST(EncodedForm, NoPrefixAndNoExtensionAddsUp) {
    for_each_example([](const auto& message) {
        auto bytes = encoded(message);
        for (std::size_t size = 0; size < bytes.size(); ++size) {
            EXPECT_FALSE(lengths_add_up(message, std::span(bytes).first(size)))
                << message.getTypeName() << " " << size;
        }
        bytes.push_back(0);
        EXPECT_FALSE(lengths_add_up(message, bytes)) << message.getTypeName();
    });
}

TEST(EncodedForm, EveryExampleComesBackFromItsBytes) {
    for_each_example([](const auto& message) {
        std::remove_cvref_t<decltype(message)> back{};
        EXPECT_EQ(decode(encoded(message), back), std::nullopt) << message.getTypeName();
        EXPECT_EQ(encoded(back), encoded(message)) << message.getTypeName();
    });
}

TEST(EncodedForm, AForgedCountAllocatesNothing) {
    // The count of particles stands after hash, utime and seq. 2^29 floats overflow an int of bytes in the
    // generated decoder.
    for (const int first : {0x20, 0x40, 0x7f, 0x80, 0xff}) {
        auto bytes = encoded(example_particles());
        bytes[24] = static_cast<std::uint8_t>(first);
        particles_t back{};
        EXPECT_NE(decode(bytes, back), std::nullopt);
        EXPECT_TRUE(back.x.empty());
    }
}

TEST(EncodedForm, StringsEndWhereTheySay) {
    auto bytes = encoded(example_slice());  // "front" stands after hash, utime, seq and its length 6
    image_slice_t back{};
    ASSERT_EQ(bytes[27], 6);
    for (const int length : {0, 5, 7, 255}) {
        auto forged = bytes;
        forged[27] = static_cast<std::uint8_t>(length);
        EXPECT_NE(decode(forged, back), std::nullopt) << length;
    }
    auto early_end = bytes;
    early_end[29] = 0;
    EXPECT_NE(decode(early_end, back), std::nullopt);
    auto no_end = bytes;
    no_end[33] = 'x';
    EXPECT_NE(decode(no_end, back), std::nullopt);
}

TEST(EncodedForm, AMessageOfAnotherTypeIsRecognised) {
    pose_t pose{};
    EXPECT_EQ(decode(encoded(example_odometry()), pose), "not of type pose_t");
    EXPECT_EQ(decode({}, pose), "not of type pose_t");
}

}  // namespace
}  // namespace goalmouth
