#include "core/conversion/truth.h"

#include <algorithm>

namespace goalmouth {
namespace {

void put(const Eigen::Vector2d& from, double (&to)[2]) {
    to[0] = from.x();
    to[1] = from.y();
}

}  // namespace

truth_t to_message(const Truth& truth, std::int64_t utime, std::int64_t seq) {
    truth_t m{};
    m.utime = utime;
    m.seq = seq;
    m.x = truth.robot.x;
    m.y = truth.robot.y;
    m.theta = truth.robot.theta;
    std::copy_n(truth.T_WC.translation().data(), 3, m.camera_translation);
    const Eigen::Quaterniond q(truth.T_WC.linear());
    m.camera_quaternion[0] = q.w();
    m.camera_quaternion[1] = q.x();
    m.camera_quaternion[2] = q.y();
    m.camera_quaternion[3] = q.z();
    m.ball_x = truth.ball.x();
    m.ball_y = truth.ball.y();
    for (const TruePost& post : truth.posts) {
        truth_post_t p{};
        p.id = post.id;
        p.x = post.position.x();
        p.y = post.position.y();
        p.distance_m = post.distance_m;
        p.bearing_rad = post.bearing_rad;
        put(post.edges.left_top, p.left_top);
        put(post.edges.left_base, p.left_base);
        put(post.edges.right_top, p.right_top);
        put(post.edges.right_base, p.right_base);
        p.visible = post.visible;
        m.posts.push_back(p);
    }
    m.num_posts = static_cast<std::int32_t>(m.posts.size());
    return m;
}

Truth from_message(const truth_t& m) {
    Truth truth;
    truth.robot = {m.x, m.y, m.theta};
    truth.T_WC.translation() = Eigen::Vector3d(m.camera_translation);
    truth.T_WC.linear() = Eigen::Quaterniond(m.camera_quaternion[0], m.camera_quaternion[1],
                                             m.camera_quaternion[2], m.camera_quaternion[3])
                              .normalized()
                              .toRotationMatrix();
    truth.ball = {m.ball_x, m.ball_y};
    for (const truth_post_t& p : m.posts) {
        TruePost post;
        post.id = p.id;
        post.position = {p.x, p.y};
        post.distance_m = p.distance_m;
        post.bearing_rad = p.bearing_rad;
        post.edges = {Eigen::Vector2d(p.left_base), Eigen::Vector2d(p.left_top),
                      Eigen::Vector2d(p.right_base), Eigen::Vector2d(p.right_top)};
        post.visible = p.visible;
        truth.posts.push_back(post);
    }
    return truth;
}

}  // namespace goalmouth
