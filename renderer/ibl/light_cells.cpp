#include "renderer/ibl/light_cells.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostColumns = 512, kMostRows = 256;  ///< of blocks: finer borders gain nothing
constexpr int kSplits = 8;                          ///< a cell is split at a multiple of this part of it

struct Sum {
    double light = 0.0;
    glm::dvec3 moment{0.0};  ///< ∫ direction · mean channel dω
};
Sum operator+(const Sum& a, const Sum& b) { return {a.light + b.light, a.moment + b.moment}; }
Sum operator-(const Sum& a, const Sum& b) { return {a.light - b.light, a.moment - b.moment}; }

struct Span {
    int begin = 0, end = 0;
    int length() const { return end - begin; }
};

/// Sums over the blocks above and left of each corner, from which that of any rectangle follows.
class BlockSums {
public:
    explicit BlockSums(const PanoramaTexels& texels)
        : texels_(texels),
          columns_(std::min(texels.width, kMostColumns)),
          rows_(std::min(texels.height, kMostRows)),
          sums_(std::size_t(columns_ + 1) * (rows_ + 1)) {
        for (int y = 0; y < rows_; ++y) {
            Sum row;
            for (int x = 0; x < columns_; ++x) {
                row = row + block(x, y);
                sums_[at(x + 1, y + 1)] = sums_[at(x + 1, y)] + row;
            }
        }
    }
    int columns() const { return columns_; }
    int rows() const { return rows_; }
    int texel_column(int block) const { return int(std::int64_t(block) * texels_.width / columns_); }
    int texel_row(int block) const { return int(std::int64_t(block) * texels_.height / rows_); }
    Sum over(Span x, Span y) const {
        return sums_[at(x.end, y.end)] - sums_[at(x.begin, y.end)] - sums_[at(x.end, y.begin)] +
               sums_[at(x.begin, y.begin)];
    }

private:
    std::size_t at(int x, int y) const { return std::size_t(y) * (columns_ + 1) + x; }
    Sum block(int column, int row) const {
        Sum sum;
        for (int y = texel_row(row); y < texel_row(row + 1); ++y) {
            const double area = texel_solid_angle(texels_, y);
            for (int x = texel_column(column); x < texel_column(column + 1); ++x) {
                const double light =
                    area * mean_channel(texels_.radiance[std::size_t(y) * texels_.width + x]);
                sum.light += light;
                sum.moment += light * texel_direction(texels_, x + 0.5, y + 0.5);
            }
        }
        return sum;
    }

    const PanoramaTexels& texels_;
    int columns_, rows_;
    std::vector<Sum> sums_;
};

/// A cell while it is still counted in blocks.
struct Part {
    Span x, y;
    LightCell cell;
    double size = 0.0;  ///< light × angular radius: about how much its light may differ in what it does
};

Part make_part(const PanoramaTexels& texels, const BlockSums& blocks, Span x, Span y) {
    const Sum sum = blocks.over(x, y);
    Part part{x, y, {}};
    LightCell& cell = part.cell;
    cell.left = blocks.texel_column(x.begin);
    cell.right = blocks.texel_column(x.end);
    cell.top = blocks.texel_row(y.begin);
    cell.bottom = blocks.texel_row(y.end);
    cell.light = std::max(sum.light, 0.0);
    cell.direction = texel_direction(texels, 0.5 * (cell.left + cell.right), 0.5 * (cell.top + cell.bottom));
    const double length = glm::length(sum.moment);
    if (cell.light > 0.0 && length > 1e-6 * cell.light) cell.direction = sum.moment / length;
    // Of a texel with itself, and of the texels with each other.
    const double sine = std::sqrt(std::max(0.0, 1.0 - cell.direction.y * cell.direction.y));
    const double height = kPi / texels.height, width = 2.0 * kPi / texels.width * sine;
    const double between = cell.light > 0.0 ? 2.0 * std::max(0.0, 1.0 - length / cell.light) : 0.0;
    cell.spread = between + (height * height + width * width) / 12.0;
    part.size = cell.light * std::sqrt(cell.spread);
    return part;
}

/// Into the two that are smallest together. Precondition: more than one block.
std::pair<Part, Part> split(const PanoramaTexels& texels, const BlockSums& blocks, const Part& part) {
    std::pair<Part, Part> best;
    double smallest = -1.0;
    for (const bool across : {true, false}) {
        const Span side = across ? part.x : part.y;
        for (int k = 1; k < kSplits; ++k) {
            const int middle = side.begin + side.length() * k / kSplits;
            if (middle == side.begin) continue;
            const Span first{side.begin, middle}, second{middle, side.end};
            const Part one = make_part(texels, blocks, across ? first : part.x, across ? part.y : first);
            const Part two = make_part(texels, blocks, across ? second : part.x, across ? part.y : second);
            if (smallest >= 0.0 && one.size + two.size >= smallest) continue;
            smallest = one.size + two.size;
            best = {one, two};
        }
    }
    return best;
}

}  // namespace

double mean_channel(glm::vec3 radiance) {
    return (double(radiance.x) + double(radiance.y) + double(radiance.z)) / 3.0;
}

double texel_solid_angle(const PanoramaTexels& texels, int row) {
    const double ring = std::cos(row * kPi / texels.height) - std::cos((row + 1) * kPi / texels.height);
    return ring * 2.0 * kPi / texels.width;
}

glm::dvec3 texel_direction(const PanoramaTexels& texels, double x, double y) {
    const int row = std::min(int(y), texels.height - 1);
    const double top = std::cos(row * kPi / texels.height);
    const double bottom = std::cos((row + 1) * kPi / texels.height);
    const double cosine = std::clamp(top + (y - row) * (bottom - top), -1.0, 1.0);
    const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    const double phi = 2.0 * kPi * x / texels.width;
    return {-sine * std::sin(phi), cosine, sine * std::cos(phi)};
}

std::vector<LightCell> divide_light(const PanoramaTexels& texels, int count) {
    const BlockSums blocks(texels);
    std::vector<Part> parts{make_part(texels, blocks, {0, blocks.columns()}, {0, blocks.rows()})};
    while (int(parts.size()) < count) {
        const auto splittable = [](const Part& part) {
            return part.x.length() > 1 || part.y.length() > 1 ? part.size : 0.0;
        };
        const auto largest = std::max_element(parts.begin(), parts.end(), [&](const Part& a, const Part& b) {
            return splittable(a) < splittable(b);
        });
        if (!(splittable(*largest) > 0.0)) break;
        auto [one, two] = split(texels, blocks, *largest);
        *largest = one;
        parts.insert(largest + 1, two);
    }
    std::vector<LightCell> cells;
    for (const Part& part : parts) cells.push_back(part.cell);
    return cells;
}

}  // namespace patina
