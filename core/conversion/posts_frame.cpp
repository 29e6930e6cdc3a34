#include "core/conversion/posts_frame.h"

#include "core/conversion/intrinsics.h"
#include "core/conversion/posts.h"

namespace goalmouth {

PostsFrame posts_frame(const posts_t& message) {
    return {message.utime, message.seq, from_message(message.intrinsics), from_message(message)};
}

}  // namespace goalmouth
