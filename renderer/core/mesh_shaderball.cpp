#include "renderer/core/mesh_shaderball.h"

#include "renderer/core/mesh_lathe.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
using Profile = std::vector<ProfilePoint>;

/// A circle in the plane of a profile. The surface lies on it with the normal pointing away from the centre
/// (convex) or towards it (concave).
struct Circle {
    glm::dvec2 center{0.0};
    double radius = 0.0;
    double outward = 1.0;  ///< 1 convex, −1 concave
};

double angle_of(const glm::dvec2& d) { return std::atan2(d.y, d.x); }
glm::dvec2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

void append_point(Profile& profile, ProfilePoint point) {
    if (!profile.empty() && glm::distance(profile.back().position, point.position) < 1e-9) {
        if (glm::distance(profile.back().normal, point.normal) < 1e-6) return;
        point.position = profile.back().position;  // a crease
    }
    profile.push_back(point);
}

/// From one angle to another, counter-clockwise around a convex circle and clockwise around a concave one.
void append_arc(Profile& profile, const Circle& circle, double from, double to, int segments) {
    const double turn = circle.outward > 0.0 ? std::fmod(to - from + 4.0 * kPi, 2.0 * kPi)
                                             : -std::fmod(from - to + 4.0 * kPi, 2.0 * kPi);
    for (int i = 0; i <= segments; ++i) {
        const glm::dvec2 d = direction(from + turn * i / segments);
        append_point(profile, {circle.center + circle.radius * d, circle.outward * d});
    }
}

void append_line(Profile& profile, const glm::dvec2& from, const glm::dvec2& to, int segments) {
    const glm::dvec2 d = glm::normalize(to - from);
    for (int i = 0; i <= segments; ++i)
        append_point(profile, {glm::mix(from, to, double(i) / segments), {d.y, -d.x}});
}

/// Ends on the axis exactly, and v along the length.
Profile finished(Profile profile) {
    std::vector<double> length{0.0};
    for (std::size_t i = 1; i < profile.size(); ++i)
        length.push_back(length.back() + glm::distance(profile[i - 1].position, profile[i].position));
    for (std::size_t i = 0; i < profile.size(); ++i) profile[i].v = length[i] / length.back();
    for (ProfilePoint* end : {&profile.front(), &profile.back()})
        if (std::abs(end->position.x) < 1e-9) end->position.x = 0.0;
    return profile;
}

/// Where the circle of that radius around a meets the one around b, on the side of positive x.
glm::dvec2 meeting_point(const Circle& a, const Circle& b) {
    const glm::dvec2 ab = b.center - a.center;
    const double distance2 = glm::dot(ab, ab);
    const double along = 0.5 * (1.0 + (a.radius * a.radius - b.radius * b.radius) / distance2);
    const double across = std::sqrt(a.radius * a.radius / distance2 - along * along);
    const glm::dvec2 side(ab.y, -ab.x);
    return a.center + along * ab + across * side;
}

constexpr double kBallRadius = 0.74;

/// The ball with a groove around it, a rounded lip, and a bowl sunk into its top. Every arc begins in the
/// direction in which the one before ends: fillets touch their neighbours, so their centres lie where circles
/// grown or shrunk by the fillet's radius meet.
Profile ball_profile() {
    const Circle ball{{0.0, 0.0}, kBallRadius};
    const Circle bowl{{0.0, 0.62}, 0.47, -1.0};
    constexpr double lip_radius = 0.028;
    const Circle lip{
        meeting_point({ball.center, ball.radius - lip_radius}, {bowl.center, bowl.radius + lip_radius}),
        lip_radius};

    constexpr double groove_latitude = 12.0 / 180.0 * kPi;
    constexpr double fillet_radius = 0.02;
    const Circle groove{(kBallRadius + 0.005) * direction(groove_latitude), 0.042, -1.0};
    const auto fillet_beside =
        [&](double side) {  // at an angle δ from the groove's middle, by the law of cosines
            const double a = kBallRadius - fillet_radius;
            const double b = glm::length(groove.center);
            const double c = groove.radius + fillet_radius;
            const double delta = std::acos((a * a + b * b - c * c) / (2.0 * a * b));
            return Circle{a * direction(groove_latitude + side * delta), fillet_radius};
        };
    const Circle below = fillet_beside(-1.0);
    const Circle above = fillet_beside(1.0);

    Profile profile;
    append_arc(profile, ball, -kPi / 2.0, angle_of(below.center), 48);
    append_arc(profile, below, angle_of(below.center), angle_of(groove.center - below.center), 12);
    append_arc(profile, groove, angle_of(below.center - groove.center),
               angle_of(above.center - groove.center), 16);
    append_arc(profile, above, angle_of(groove.center - above.center), angle_of(above.center), 12);
    append_arc(profile, ball, angle_of(above.center), angle_of(lip.center), 30);
    append_arc(profile, lip, angle_of(lip.center), angle_of(bowl.center - lip.center), 12);
    append_arc(profile, bowl, angle_of(lip.center - bowl.center), -kPi / 2.0, 32);
    return finished(std::move(profile));
}

Profile pearl_profile(double radius) {
    Profile profile;
    append_arc(profile, {{0.0, 0.0}, radius}, -kPi / 2.0, kPi / 2.0, 48);
    return finished(std::move(profile));
}

/// A foot with a round edge, a trumpet-shaped neck, and a flat top that is hidden in the ball.
Profile stand_profile() {
    Profile profile;
    append_line(profile, {0.0, -0.86}, {0.47, -0.86}, 8);
    append_arc(profile, {{0.47, -0.83}, 0.03}, -kPi / 2.0, kPi / 2.0, 12);
    append_arc(profile, {{0.47, -0.53}, 0.27, -1.0}, -kPi / 2.0, kPi, 32);
    append_line(profile, {0.2, -0.53}, {0.2, -0.4}, 2);
    append_line(profile, {0.2, -0.4}, {0.0, -0.4}, 3);
    return finished(std::move(profile));
}

Profile collar_profile() {
    Profile profile;
    constexpr int segments = 24;
    for (int i = 0; i <= segments; ++i) {  // from the inside around; both ends exactly one point
        const glm::dvec2 d = direction(kPi + 2.0 * kPi * (i % segments) / segments);
        profile.push_back({glm::dvec2(0.212, -0.505) + 0.036 * d, d});
    }
    return finished(std::move(profile));
}

void place(Mesh& mesh, std::size_t first_vertex, const glm::dmat3& turn, const glm::dvec3& offset) {
    for (std::size_t i = first_vertex; i < mesh.vertices.size(); ++i) {
        Vertex& vertex = mesh.vertices[i];
        vertex.position = glm::vec3(turn * glm::dvec3(vertex.position) + offset);
        vertex.normal = glm::vec3(turn * glm::dvec3(vertex.normal));
    }
}

/// The axis leans towards the viewer and a little to the right.
glm::dmat3 ball_turn() {
    constexpr double lean_angle = 48.0 / 180.0 * kPi;
    constexpr double yaw_angle = 18.0 / 180.0 * kPi;
    const glm::dmat3 lean(1, 0, 0, 0, std::cos(lean_angle), std::sin(lean_angle), 0, -std::sin(lean_angle),
                          std::cos(lean_angle));
    const glm::dmat3 yaw(std::cos(yaw_angle), 0, -std::sin(yaw_angle), 0, 1, 0, std::sin(yaw_angle), 0,
                         std::cos(yaw_angle));
    return yaw * lean;
}

}  // namespace

Mesh make_shaderball() {
    constexpr double pearl_radius = 0.27;
    constexpr glm::dvec3 ball_center(0.0, 0.22, 0.0);
    const glm::dmat3 turn = ball_turn();
    Mesh mesh;
    mesh.name = "shaderball";
    append_lathe(mesh, ball_profile());
    place(mesh, 0, turn, ball_center);
    const std::size_t pearl = mesh.vertices.size();
    append_lathe(mesh, pearl_profile(pearl_radius), {.segments = 96});
    place(mesh, pearl, glm::dmat3(1.0),
          ball_center + turn * glm::dvec3(0.0, 0.15 + pearl_radius - 0.01, 0.0));
    append_lathe(mesh, stand_profile(), {.segments = 128});
    append_lathe(mesh, collar_profile(), {.segments = 128});
    normalize_to_unit_sphere(mesh);
    return mesh;
}

}  // namespace patina
