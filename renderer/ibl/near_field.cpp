#include "renderer/ibl/near_field.h"

#include "renderer/ibl/near_simd.h"

#include <algorithm>
#include <cmath>
#include <numbers>

// With the chord d = |N − L| and c = 2α/√(1 − α²) the kernel is
//     K = (1 − d²/2) · 16α²/(1 − α²)² · (d² + c²)⁻²,
// and d² = y² + x² for y = 2 sin(Δθ/2), x = 2 √(sin θ sin θ_N) sin(Δφ/2): exactly, and with areas kept up to
// the row's own sin θ. In these coordinates a texel is a rectangle as far as it is small.
//
// Three ways to take the mean of K over a texel of h_x × h_y:
// - at its centre, with the second-order term h_x²/24 ∂²K/∂x² + h_y²/24 ∂²K/∂y²: errs by ½ % at three sides'
//   distance, and like the fourth power of it;
// - nearer, by the integral of (x² + y² + c²)⁻² over a rectangle, which is elementary:
//     (x/a · atan(y/a) + y/b · atan(x/b)) / 2c²,  a² = x² + c², b² = y² + c²,
//   in double, because it is a difference of large numbers;
// - around the poles, where texels are wedges: by rows cut into thin ones, at their centres.
// Sums are divided by those of the kernel alone, so a constant panorama stays as it is.

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRowsAtLeast = 256;     ///< of a panorama whose texels count as flat
constexpr double kReach = 16.0;       ///< texels that the near part reaches
constexpr double kLeastReach = 0.02;  ///< radians
constexpr double kInner = 0.4;        ///< of the reach: the window is 1 up to there
constexpr double kMiddle = 3.0;       ///< texel sides up to which texels are integrated in closed form
constexpr double kPolarRows = 8.0;    ///< distance from a pole, in texels, where they are wedges
constexpr int kMostParts = 32;
constexpr double kLeastAlpha = 1e-5;  ///< far narrower than any texel

}  // namespace

/// Where a texel of the cube looks on the panorama.
struct NearField::Place {
    double theta, sine;       ///< of N
    Angle half;               ///< θ/2
    double column;            ///< of N, in columns
    int first_row, last_row;  ///< within reach
    int half_columns;         ///< within reach in the widest row
};

struct NearField::Sums {
    double light[3] = {};
    double kernel = 0.0;
};

struct NearField::Scratch {
    std::vector<float> square;  ///< 4 sin²(Δφ/2) of every column, then of no column: huge
    std::vector<double> edges, x, corners;
};

struct NearField::Lobe {
    KernelSplit split;
    double spread;  ///< c²
    simd::NearLobe simd;
};

struct NearField::Middle {
    int first_row, last_row, columns;
};

NearField::NearField(const RadianceView& view, const BakeControl& control) {
    const int row_repeat = (kRowsAtLeast + view.height - 1) / view.height;
    const int column_repeat = (2 * kRowsAtLeast + view.width - 1) / view.width;
    grid_ = {view.width * column_repeat, view.height * row_repeat};
    stride_ = std::size_t(grid_.width) + simd::kNearPadding;
    planes_.reserve(3 * stride_ * grid_.height);
    control.parallel_for(grid_.height, [&](int y) {
        const glm::vec3* row = view.rows[y / row_repeat];
        for (int channel = 0; channel < 3; ++channel) {
            float* to = planes_.data() + (std::size_t(channel) * grid_.height + y) * stride_;
            for (int x = 0; x < grid_.width; ++x) to[x] = row[x / column_repeat][channel];
            std::fill(to + grid_.width, to + stride_, 0.0f);
        }
    });
    for (int y = 0; y < grid_.height; ++y) {
        row_.push_back(part_of(y, 0, 1));
        edge_.push_back(Angle(0.5 * y * grid_.row_height()));
    }
    edge_.push_back(Angle(kPi / 2));
    for (int k = -grid_.width; k <= grid_.width; ++k) {
        half_sine_.push_back(float(std::sin(0.5 * k * grid_.column_width())));
        half_cosine_.push_back(float(std::cos(0.5 * k * grid_.column_width())));
    }
}

NearField::Angle::Angle(double angle) : sine(std::sin(angle)), cosine(std::cos(angle)) {}

const float* NearField::plane(int channel, int y) const {
    return planes_.data() + (std::size_t(channel) * grid_.height + y) * stride_;
}

double NearField::largest_side() const { return std::max(grid_.row_height(), grid_.column_width()); }

KernelSplit NearField::split() const {
    const double outer = std::max(kReach * largest_side(), kLeastReach);
    return {kInner * kInner * outer * outer, outer * outer};
}

NearField::Place NearField::place_of(glm::vec3 N, double outer) const {
    Place place{};
    place.theta = std::atan2(std::hypot(double(N.x), double(N.z)), double(N.y));
    place.sine = std::sin(place.theta);
    place.half = Angle(0.5 * place.theta);
    const double turn = 0.5 + std::atan2(double(N.x), -double(N.z)) / (2.0 * kPi);
    place.column = std::min(turn * grid_.width, grid_.width - 1e-6);
    const double reach = 2.0 * std::asin(std::min(1.0, 0.5 * outer));
    place.first_row = std::max(0, int((place.theta - reach) / grid_.row_height()));
    place.last_row = std::min(grid_.height - 1, int((place.theta + reach) / grid_.row_height()));
    const double narrowest = std::min(std::sin((place.first_row + 0.25) * grid_.row_height()),
                                      std::sin((place.last_row + 0.75) * grid_.row_height()));
    const double square = 0.25 * outer * outer / std::max(1e-12, place.sine * narrowest);
    place.half_columns = grid_.width;
    if (square < 0.49)  // as for a row, below
        place.half_columns = int(2.0 * std::sqrt(square) * (1.0 + 0.25 * square) / grid_.column_width()) + 2;
    return place;
}

void NearField::set_columns(const Place& place, Scratch& scratch) const {
    const int width = grid_.width, middle = int(place.column);
    const double offset = 0.5 * (0.5 - (place.column - middle)) * grid_.column_width();
    const float sine = float(2.0 * std::sin(offset)), cosine = float(2.0 * std::cos(offset));
    // The run of columns first … last lies at first − middle … columns from N.
    const auto fill = [&](int first, int last, int relative) {
        const float* s = half_sine_.data() + width + relative;
        const float* c = half_cosine_.data() + width + relative;
        float* to = scratch.square.data() + first;
        for (int i = 0; i < last - first; ++i) {
            const float x = s[i] * cosine + c[i] * sine;
            to[i] = x * x;
        }
    };
    const int reach = place.half_columns + simd::kNearPadding;
    if (2 * reach + 1 >= width) {
        fill(0, width, -middle);  // a whole turn more or less has the same square
        return;
    }
    const int first = middle - reach, last = middle + reach + 1;
    if (first < 0) fill(first + width, width, -reach);
    if (last > width) fill(0, last - width, width - middle);
    fill(std::max(0, first), std::min(width, last), std::max(0, first) - middle);
}

/// Part k of a row cut into equal heights. The mean over it lies where sin θ puts it, see sh_transform.cpp.
NearField::RowPart NearField::part_of(int y, int k, int parts) const {
    RowPart part{y, grid_.row_height() / parts, {}, 0.0};
    const double middle = (y + (k + 0.5) / parts) * grid_.row_height();
    const double theta = middle + part.height * part.height / 24.0 / std::tan(middle);
    part.half = Angle(0.5 * theta);
    part.sine = std::sin(theta);
    return part;
}

/// The part's texels at their centres.
void NearField::add_row(const Place& place, const Lobe& lobe, const RowPart& part, const Scratch& scratch,
                        Sums& sums) const {
    const double y = 2.0 * part.half.sine_from(place.half), y_square = y * y;
    const double metric = part.sine * place.sine;
    if (y_square >= lobe.split.outer_square) return;
    const double column_side = grid_.column_width();
    simd::NearRow row;
    row.red = plane(0, part.y);
    row.green = plane(1, part.y);
    row.blue = plane(2, part.y);
    row.square = scratch.square.data();
    row.metric = float(metric);
    row.y_square = float(y_square);
    row.column_side_square = float(metric * column_side * column_side);
    row.row_side_square = float(part.height * part.height);
    double row_sums[4] = {};
    const double reach_square = (lobe.split.outer_square - y_square) / (4.0 * metric);
    int reach = grid_.width;
    if (reach_square < 0.49) {  // asin x ≤ x + x³/4 there
        const double half_sine = std::sqrt(reach_square);
        reach = int(2.0 * half_sine * (1.0 + 0.25 * reach_square) / column_side) + 2;
    }
    const int middle = int(place.column);
    const auto add = [&](int begin, int end) { simd::add_near_row(lobe.simd, row, begin, end, row_sums); };
    if (2 * reach + 1 + simd::kNearPadding >= grid_.width) {
        add(0, grid_.width);
    } else {
        const int begin = middle - reach, end = middle + reach + 1;
        if (begin < 0) add(begin + grid_.width, grid_.width);
        if (end > grid_.width) add(0, end - grid_.width);
        add(std::max(0, begin), std::min(grid_.width, end));
    }
    const double area = part.sine * part.height;  // a texel's width is the same everywhere
    for (int c = 0; c < 3; ++c) sums.light[c] += area * row_sums[c];
    sums.kernel += area * row_sums[3];
}

/// Rows first … last by closed form in the columns −columns … columns around N; the others at their centres.
void NearField::add_middle(const Place& place, const Lobe& lobe, const Middle& middle, Scratch& scratch,
                           Sums& sums) const {
    const int width = grid_.width, count = 2 * middle.columns + 1;
    const int first = int(place.column) - middle.columns;
    scratch.edges.resize(std::size_t(count) + 1);
    scratch.x.resize(scratch.edges.size() + simd::kNearPadding);
    scratch.corners.resize(scratch.x.size());
    for (int k = 0; k <= count; ++k)
        scratch.edges[k] = 2.0 * std::sin(0.5 * (first + k - place.column) * grid_.column_width());
    for (int k = 0; k < count; ++k) scratch.square[(first + k + width) % width] = simd::kNearHuge;
    for (int y = middle.first_row; y <= middle.last_row; ++y) {
        const RowPart& row = row_[y];
        add_row(place, lobe, row, scratch, sums);
        const double metric = std::sqrt(row.sine * place.sine);
        const double top = 2.0 * edge_[y].sine_from(place.half);
        const double bottom = 2.0 * edge_[y + 1].sine_from(place.half);
        for (int k = 0; k <= count; ++k) scratch.x[k] = metric * scratch.edges[k];
        simd::near_corners({scratch.x.data(), count + 1, top, bottom}, lobe.spread, scratch.corners.data());
        for (int k = 0; k < count; ++k) {
            const double x = 0.5 * (scratch.x[k] + scratch.x[k + 1]), middle_y = 0.5 * (top + bottom);
            const double square = x * x + middle_y * middle_y;
            const double mean = (scratch.corners[k + 1] - scratch.corners[k]) /
                                ((scratch.x[k + 1] - scratch.x[k]) * (bottom - top));
            const double weight =
                row.sine * row.height * mean * (1.0 - 0.5 * square) * lobe.split.window(square);
            const int column = (first + k + width) % width;
            for (int c = 0; c < 3; ++c) sums.light[c] += weight * plane(c, y)[column];
            sums.kernel += weight;
        }
    }
}

NearField::Sums NearField::sum(const Place& place, const Lobe& lobe, Scratch& scratch) const {
    Sums sums;
    set_columns(place, scratch);
    const double height = grid_.row_height(), column_side = grid_.column_width() * place.sine;
    const double larger = std::max(height, column_side);
    const int rows = int(std::ceil(kMiddle * larger / height));
    const bool is_polar = std::min(place.theta, kPi - place.theta) < kPolarRows * larger;
    Middle middle{std::max(0, int(place.theta / height) - rows),
                  std::min(grid_.height - 1, int(place.theta / height) + rows),
                  std::min(int(std::ceil(kMiddle * larger / column_side)), (grid_.width - 1) / 2 - 1)};
    const int parts =
        is_polar ? std::clamp(int(std::ceil(4.0 * height / std::sqrt(lobe.spread))), 1, kMostParts) : 1;
    for (int y = place.first_row; y <= place.last_row; ++y) {
        const bool is_middle = y >= middle.first_row && y <= middle.last_row;
        if (is_middle && !is_polar) continue;
        if (!is_middle) add_row(place, lobe, row_[y], scratch, sums);
        for (int k = 0; k < parts && is_middle; ++k)
            add_row(place, lobe, part_of(y, k, parts), scratch, sums);
    }
    if (!is_polar) add_middle(place, lobe, middle, scratch, sums);
    return sums;
}

void NearField::add(double alpha, const KernelSplit& split, CubeMap& cube, const BakeControl& control) const {
    const double share = 1.0 - ggx_far_zonal(alpha, split, 0).front();
    const double a = std::max(alpha, kLeastAlpha);
    Lobe lobe{split, 4.0 * a * a / (1.0 - a * a), {}};
    lobe.simd = {float(lobe.spread), float(split.inner_square),
                 float(1.0 / (split.outer_square - split.inner_square))};
    const double outer = std::sqrt(split.outer_square);
    const auto make_scratch = [&] {
        Scratch scratch;
        scratch.square.assign(stride_, simd::kNearHuge);
        return scratch;
    };
    run_tasks(control, 6 * cube.size, make_scratch, [&](int row, Scratch& scratch) {
        for (int x = 0; x < cube.size; ++x) {
            const glm::vec3 N = cube_texel_direction(cube.size, row / cube.size, x, row % cube.size);
            const Sums sums = sum(place_of(N, outer), lobe, scratch);
            glm::vec3& texel = cube.texels[std::size_t(row) * cube.size + x];
            for (int c = 0; c < 3; ++c) texel[c] += float(share * sums.light[c] / sums.kernel);
        }
    });
}

}  // namespace patina
