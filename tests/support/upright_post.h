#pragma once

#include "core/detection/post.h"
#include "core/evaluation/reference_post.h"

namespace goalmouth::test {

/// True post with upright edges at x = `left` and `right`, from row `top` to row `base`.
inline ReferencePost truth_at(double left, double right, double top = 100.0, double base = 300.0) {
    return {{left, top}, {left, base}, {right, top}, {right, base}};
}

/// A detection of one.
inline Post post_at(double left, double right, double top = 100.0, double base = 300.0) {
    Post post;
    post.left_top = {left, top};
    post.left_base = {left, base};
    post.right_top = {right, top};
    post.right_base = {right, base};
    return post;
}

}  // namespace goalmouth::test
