#include "renderer/core/mesh_triangulate.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// Newell: the sum of cross products of successive corners, twice the vector area, for any polygon.
glm::dvec3 area_vector(std::span<const glm::dvec3> corners) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return sum;
}

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Seen against the normal, so that the polygon runs counter-clockwise.
std::vector<glm::dvec2> flatten(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
    const glm::dvec3 a = glm::abs(normal);
    const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                            : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                     : glm::dvec3(0, 0, 1);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, normal));
    const glm::dvec3 up = glm::cross(normal, right);
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& p : corners) {
        const glm::dvec3 d = p - corners[0];
        flat.emplace_back(glm::dot(d, right), glm::dot(d, up));
    }
    return flat;
}

void cut_quad(const std::vector<glm::dvec2>& p, double diagonal02, double diagonal13,
              std::vector<Triangle>& out) {
    const bool can02 = cross(p[0], p[1], p[2]) > 0.0 && cross(p[0], p[2], p[3]) > 0.0;
    const bool can13 = cross(p[1], p[2], p[3]) > 0.0 && cross(p[1], p[3], p[0]) > 0.0;
    if (can13 && (!can02 || diagonal13 < diagonal02))
        out.insert(out.end(), {{1, 2, 3}, {1, 3, 0}});
    else
        out.insert(out.end(), {{0, 1, 2}, {0, 2, 3}});
}

bool is_convex(const std::vector<glm::dvec2>& p) {
    const std::size_t n = p.size();
    int downturns = 0;  // a convex polygon changes from rising to falling once
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec2& a = p[i];
        const glm::dvec2& b = p[(i + 1) % n];
        const glm::dvec2& c = p[(i + 2) % n];
        if (cross(a, b, c) < 0.0) return false;
        if (b.y > a.y && c.y <= b.y) ++downturns;
    }
    return downturns <= 1;
}

/// Zigzag between both ends: no corner collects all triangles.
void cut_convex(std::uint32_t n, std::vector<Triangle>& out) {
    std::uint32_t low = 0;
    std::uint32_t high = n - 1;
    for (bool from_low = true; high - low >= 2; from_low = !from_low) {
        if (from_low) {
            out.push_back({low, low + 1, high});
            ++low;
        } else {
            out.push_back({low, high - 1, high});
            --high;
        }
    }
}

/// The reflex corners in a uniform grid: only they can lie inside an ear.
class ReflexGrid {
public:
    explicit ReflexGrid(const std::vector<glm::dvec2>& points)
        : points_(points), low_(points[0]), high_(points[0]) {
        for (const glm::dvec2& p : points) {
            low_ = glm::min(low_, p);
            high_ = glm::max(high_, p);
        }
        side_ = std::max<std::size_t>(1, std::size_t(std::sqrt(double(points.size()))));
        cells_.resize(side_ * side_);
    }

    void add(std::uint32_t i) { cells_[row(points_[i].y) * side_ + column(points_[i].x)].push_back(i); }

    /// Whether test(i) holds for any entry in the cells the box touches; entries for which gone(i) holds are
    /// forgotten.
    template <class Gone, class Test>
    bool any_in(const glm::dvec2& low, const glm::dvec2& high, const Gone& gone, const Test& test) {
        for (std::size_t y = row(low.y); y <= row(high.y); ++y)
            for (std::size_t x = column(low.x); x <= column(high.x); ++x) {
                auto& cell = cells_[y * side_ + x];
                std::erase_if(cell, gone);
                if (std::any_of(cell.begin(), cell.end(), test)) return true;
            }
        return false;
    }

private:
    std::size_t step(double value, double low, double high) const {
        const double t = high > low ? (value - low) / (high - low) : 0.0;
        return std::min(side_ - 1, std::size_t(std::max(0.0, t) * double(side_)));
    }
    std::size_t column(double x) const { return step(x, low_.x, high_.x); }
    std::size_t row(double y) const { return step(y, low_.y, high_.y); }

    const std::vector<glm::dvec2>& points_;
    glm::dvec2 low_, high_;
    std::size_t side_ = 1;
    std::vector<std::vector<std::uint32_t>> cells_;
};

/// Ear clipping (Meisters 1975) around a linked list.
class EarClipper {
public:
    explicit EarClipper(const std::vector<glm::dvec2>& points)
        : points_(points),
          grid_(points),
          previous_(points.size()),
          next_(points.size()),
          reflex_(points.size()) {
        const auto n = std::uint32_t(points.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            previous_[i] = i == 0 ? n - 1 : i - 1;
            next_[i] = i + 1 == n ? 0 : i + 1;
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            reflex_[i] = turn(i) <= 0.0;
            if (reflex_[i]) grid_.add(i);
        }
    }

    void clip(std::vector<Triangle>& out) {
        std::uint32_t i = 0;
        std::uint32_t left = std::uint32_t(points_.size());
        std::uint32_t refused = 0;
        while (left > 3) {
            // After a whole round without an ear the polygon crosses itself: take what comes.
            if (refused <= left && !is_ear(i)) {
                i = next_[i];
                ++refused;
                continue;
            }
            out.push_back({previous_[i], i, next_[i]});
            i = remove(i);
            --left;
            refused = 0;
        }
        out.push_back({previous_[i], i, next_[i]});
    }

private:
    double turn(std::uint32_t i) const { return cross(points_[previous_[i]], points_[i], points_[next_[i]]); }

    bool is_ear(std::uint32_t i) {
        if (reflex_[i]) return false;
        const glm::dvec2& a = points_[previous_[i]];
        const glm::dvec2& b = points_[i];
        const glm::dvec2& c = points_[next_[i]];
        const auto blocks = [&](std::uint32_t k) {
            const glm::dvec2& p = points_[k];
            if (p == a || p == b || p == c) return false;
            return cross(a, b, p) >= 0.0 && cross(b, c, p) >= 0.0 && cross(c, a, p) >= 0.0;
        };
        return !grid_.any_in(
            glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)),
            [&](std::uint32_t k) { return !reflex_[k]; }, blocks);
    }

    /// Takes a corner out and goes on two further, so that ears are cut all around and not from one corner.
    std::uint32_t remove(std::uint32_t i) {
        const std::uint32_t before = previous_[i];
        const std::uint32_t after = next_[i];
        next_[before] = after;
        previous_[after] = before;
        reflex_[i] = false;
        for (const std::uint32_t k : {before, after}) reflex_[k] = reflex_[k] && turn(k) <= 0.0;
        return next_[after];
    }

    const std::vector<glm::dvec2>& points_;
    ReflexGrid grid_;
    std::vector<std::uint32_t> previous_, next_;
    std::vector<char> reflex_;  ///< or straight: not the tip of an ear
};

}  // namespace

void triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    if (corners.size() < 3) return;
    if (corners.size() == 3) {
        triangles.push_back({0, 1, 2});
        return;
    }
    const glm::dvec3 area = area_vector(corners);
    const double length = glm::length(area);
    if (!(length > 0.0)) return;
    const std::vector<glm::dvec2> flat = flatten(corners, area / length);
    if (corners.size() == 4)
        cut_quad(flat, glm::distance(corners[0], corners[2]), glm::distance(corners[1], corners[3]),
                 triangles);
    else if (is_convex(flat))
        cut_convex(std::uint32_t(corners.size()), triangles);
    else
        EarClipper(flat).clip(triangles);
}

}  // namespace patina
