#include "renderer/ibl/sh_transform.h"

#include "renderer/ibl/sh_simd.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>

// The analysis integrates L against the conjugate harmonics exactly enough for sharp edges between texels, at
// no cost:
//
// Azimuth. A texel from φ_x − h to φ_x + h, h = π/W, has ∫e^(−imφ) = 2h · e^(−imφ_x) · sinc(mh): the Fourier
// transform of the row, times a number for each m.
//
// Colatitude. The mean of P over a ring of height δ, weighted by sin θ, is to second order
//     P + δ²/24 · (P'' + 2 cot θ P') = P + δ²/24 · (cot θ P' − (l(l + 1) − m²/sin²θ) P)
// by Legendre's equation P'' + cot θ P' + (l(l + 1) − m²/sin²θ) P = 0. So: evaluate at θ + δ²/24 · cot θ,
// multiply the ring's value by exp(δ²m²/(24 sin²θ)) and the coefficient by exp(−δ²l(l + 1)/24). Weights are
// the rings' exact areas.
//
// North and south. P̄_lm(−x) = (−1)^(l−m) P̄_lm(x): ring pairs are folded into sum and difference, which halves
// the work.

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kBorder = 4;  ///< texels around a synthesised panorama; interpolation needs three

/// Strides that are multiples of a large power of two fall into the same cache set: keep an odd number of
/// cache lines.
std::size_t spread_stride(std::size_t floats) {
    const std::size_t lines = (floats + 15) / 16;
    return (lines | 1) * 16;
}

/// A panorama as the analysis sees it: texels repeated so that a small picture's hard edges are resolved.
struct FineRows {
    int columns, count;
    std::vector<const float*> rows;  ///< count of them
    std::vector<std::vector<glm::vec3>> widened;

    FineRows(const RadianceView& view, int band) {
        // Twice as many columns as rows; the band may pass the rows by a little, because texels are areas,
        // not samples.
        const int wanted = std::max(16, band - 88);
        const int row_repeat = (wanted + view.height - 1) / view.height;
        const int column_repeat = (2 * wanted + view.width - 1) / view.width;
        columns = view.width * column_repeat;
        count = view.height * row_repeat;
        for (const glm::vec3* row : view.rows) {
            if (column_repeat > 1) {
                std::vector<glm::vec3>& wide = widened.emplace_back();
                wide.reserve(std::size_t(columns));
                for (int x = 0; x < view.width; ++x)
                    wide.insert(wide.end(), std::size_t(column_repeat), row[x]);
                row = wide.data();
            }
            rows.insert(rows.end(), std::size_t(row_repeat), &row->x);
        }
    }
};

/// Rings of one hemisphere with what the analysis multiplies them by, padded with weightless copies of the
/// last.
struct AnalysisRings {
    int padded;
    std::vector<double> cosine, sine;
    std::vector<float> weight, widening;

    AnalysisRings(const FineRows& fine, int group) {
        const int count = (fine.count + 1) / 2;
        padded = (count + group - 1) / group * group;
        const double step = kPi / fine.count;
        for (int i = 0; i < padded; ++i) {
            const int y = std::min(i, count - 1);
            const double middle = (y + 0.5) * step;
            const double theta = middle + step * step / 24.0 / std::tan(middle);
            double area = (std::cos(y * step) - std::cos((y + 1) * step)) * 2.0 * kPi / fine.columns;
            if (2 * y + 1 == fine.count) area *= 0.5;  // the equator is its own mirror image
            cosine.push_back(std::cos(theta));
            sine.push_back(std::sin(theta));
            weight.push_back(i < count ? float(0.5 * area) : 0.0f);  // split_channel gives twice the values
            widening.push_back(float(step * step / 24.0 / (sine.back() * sine.back())));
        }
    }
};

simd::Column column_of(const LegendreTables& tables, int m, int band) {
    return {m, band, &tables.factor[tables.first[m]], &tables.factor_single[tables.first[m]]};
}

/// Rows as Fourier coefficients: [order][block of rings][part][lane].
struct Spectrum {
    int band;
    std::size_t order_stride;
    FloatBuffer values;
};

void analyse_rows(const FineRows& fine, const AnalysisRings& rings, Spectrum& spectrum,
                  const BakeControl& control) {
    const int band = spectrum.band;
    const int lanes = simd::lane_count();
    const FftPlan fft(fine.columns);
    std::vector<float> phase;
    for (int m = 0; m <= band; ++m) {
        const double angle = m * kPi / fine.columns;
        const double sinc = m == 0 ? 1.0 : std::sin(angle) / angle;
        phase.push_back(float(sinc * std::cos(angle)));
        phase.push_back(float(-sinc * std::sin(angle)));
    }
    const double step = kPi / fine.count;
    const std::size_t work_floats =
        std::size_t(2 * lanes) * (3 * std::size_t(fine.columns) + 2 * std::size_t(fft.buffer_elements()));
    const auto make_work = [&] { return FloatBuffer(work_floats); };
    run_tasks(control, rings.padded / lanes, make_work, [&](int block, FloatBuffer& work) {
        std::vector<const float*> north, south;
        for (int k = 0; k < lanes; ++k) {
            const int y = std::min(block * lanes + k, (fine.count - 1) / 2);
            north.push_back(fine.rows[y]);
            south.push_back(fine.rows[fine.count - 1 - y]);
        }
        simd::AnalysisBlock job;
        job.north = north.data();
        job.south = south.data();
        job.fft = &fft.view();
        job.orders = band + 1;
        job.useful_orders = std::min(band, (fine.columns - 1) / 2) + 1;
        job.phase = phase.data();
        job.weight = rings.weight.data() + std::size_t(block) * lanes;
        job.widening = rings.widening.data() + std::size_t(block) * lanes;
        job.largest_widening = float(step * step / 24.0 * (band + 1.0) * (band + 1.0));
        job.work = work.data();
        job.spectrum = spectrum.values.data() + std::size_t(block) * simd::kParts * lanes;
        job.order_stride = spectrum.order_stride;
        simd::analyse_rings(job);
    });
}

}  // namespace

ShCoefficients analyse(const RadianceView& view, const LegendreTables& tables, const BakeControl& control) {
    const int lanes = simd::lane_count();
    const int band = tables.band;
    const FineRows fine(view, band);
    const AnalysisRings rings(fine, simd::analysis_group());
    const std::size_t order_stride = spread_stride(std::size_t(rings.padded) * simd::kParts);
    Spectrum spectrum = {band, order_stride, FloatBuffer(order_stride * (std::size_t(band) + 1))};
    analyse_rows(fine, rings, spectrum, control);

    std::vector<double> area_mean;  // exp(−δ² l(l + 1)/24)
    for (int l = 0; l <= band; ++l)
        area_mean.push_back(std::exp(-kPi * kPi / fine.count / fine.count * l * (l + 1.0) / 24.0));
    ShCoefficients result;
    result.tables = &tables;
    result.values.reserve(6 * tables.factor.size());
    const simd::Rings ring_view = {rings.padded, rings.cosine.data(), rings.sine.data()};
    const auto make_sums = [&] { return FloatBuffer(std::size_t(band + 6) * simd::kCoefficients * lanes); };
    run_tasks(control, band + 1, make_sums, [&](int m, FloatBuffer& sums) {
        float* values = result.values.data() + 6 * tables.first[m];
        simd::analyse_order(column_of(tables, m, band), ring_view, spectrum.values.data() + order_stride * m,
                            sums.data(), values);
        for (int l = m; l <= band; ++l)
            for (int part = 0; part < 6; ++part)
                *values++ *= float(tables.norm_square[tables.at(l, m)] * area_mean[l]);
    });
    return result;
}

std::vector<double> power_spectrum(const ShCoefficients& coefficients) {
    const LegendreTables& tables = *coefficients.tables;
    std::vector<double> power(std::size_t(tables.band) + 1, 0.0);
    for (int m = 0; m <= tables.band; ++m)
        for (int l = m; l <= tables.band; ++l) {
            const float* a = coefficients.at(l, m);
            double sum = 0.0;
            for (int part = 0; part < 6; ++part) sum += double(a[part]) * a[part];
            power[l] += (m == 0 ? 1.0 : 2.0) / 3.0 * sum / tables.norm_square[tables.at(l, m)];
        }
    return power;
}

Synthesis::Synthesis(const ShCoefficients& coefficients, const BakeControl& control)
    : coefficients_(coefficients), control_(control) {}

std::size_t Synthesis::row_floats(const Grid& grid) { return std::size_t(4) * (grid.columns + 2 * kBorder); }

float* Synthesis::row(const Grid& grid, int y) const {
    return image_.data() + std::size_t(y + kBorder) * row_floats(grid) + std::size_t(4) * kBorder;
}

CubeMap Synthesis::to_cube(const std::vector<double>& zonal, int face_size, const Range& range) {
    assert(!zonal.empty() && int(zonal.size()) <= coefficients_.tables->band + 1);
    Grid grid;
    grid.band = int(zonal.size()) - 1;
    grid.rings = (std::max(16, (5 * grid.band + 3) / 4) + 1) / 2 * 2;  // 1¼ times what the band needs
    grid.columns = friendly_fft_size(2 * grid.rings, 4);
    CubeMap cube{face_size, std::vector<glm::vec3>(std::size_t(6) * face_size * face_size)};
    synthesise_orders(grid, zonal);
    if (control_.stop.stop_requested()) return cube;
    synthesise_rows(grid);
    surround(grid);
    resample(grid, range, cube);
    return cube;
}

void Synthesis::synthesise_orders(const Grid& grid, const std::vector<double>& zonal) {
    const LegendreTables& tables = *coefficients_.tables;
    const int lanes = simd::lane_count();
    const int blocks = (grid.rings / 2 + lanes - 1) / lanes;
    std::vector<double> cosine, sine;
    for (int i = 0; i < blocks * lanes; ++i) {
        const double theta = (std::min(i, grid.rings / 2 - 1) + 0.5) * kPi / grid.rings;
        cosine.push_back(std::cos(theta));
        sine.push_back(std::sin(theta));
    }
    const std::size_t block_stride = spread_stride(std::size_t(grid.band + 1) * simd::kParts * lanes);
    spectrum_.reserve(block_stride * blocks);
    const auto make_convolved = [&] { return std::vector<float>(std::size_t(grid.band + 4) * 6); };
    run_tasks(control_, grid.band + 1, make_convolved, [&](int m, std::vector<float>& convolved) {
        const float* a = coefficients_.at(m, m);
        float* to = convolved.data();
        for (int l = m; l <= grid.band; ++l)
            for (int part = 0; part < 6; ++part) *to++ = *a++ * float(zonal[l]);
        std::fill(to, to + 12, 0.0f);
        simd::SynthesisOrder job;
        job.column = column_of(tables, m, grid.band);
        job.rings = {blocks * lanes, cosine.data(), sine.data()};
        job.coefficients = convolved.data();
        job.spectrum = spectrum_.data() + std::size_t(m) * simd::kParts * lanes;
        job.block_stride = block_stride;
        simd::synthesise_order(job);
    });
}

void Synthesis::synthesise_rows(const Grid& grid) {
    const int lanes = simd::lane_count();
    const int half = grid.rings / 2;
    const int blocks = (half + lanes - 1) / lanes;
    const std::size_t block_stride = spread_stride(std::size_t(grid.band + 1) * simd::kParts * lanes);
    image_.reserve(row_floats(grid) * (grid.rings + 2 * kBorder));
    const FftPlan fft(grid.columns);
    const auto make_work = [&] { return FloatBuffer(std::size_t(6) * 2 * lanes * grid.columns); };
    run_tasks(control_, blocks, make_work, [&](int block, FloatBuffer& work) {
        std::vector<float*> north, south;
        for (int k = 0; k < lanes; ++k) {
            const int y = block * lanes + k;
            north.push_back(y < half ? row(grid, y) : nullptr);
            south.push_back(y < half ? row(grid, grid.rings - 1 - y) : nullptr);
        }
        simd::SynthesisBlock job;
        job.spectrum = spectrum_.data() + block_stride * block;
        job.orders = grid.band + 1;
        job.fft = &fft.view();
        job.work = work.data();
        job.north = north.data();
        job.south = south.data();
        simd::synthesise_rings(job);
    });
}

/// Columns continue around; rows continue across the poles, half a turn away.
void Synthesis::surround(const Grid& grid) {
    const auto copy = [](float* to, const float* from, int texels) {
        std::memcpy(to, from, std::size_t(texels) * 4 * sizeof(float));
    };
    for (int y = 0; y < grid.rings; ++y) {
        float* line = row(grid, y);
        copy(line - std::ptrdiff_t(4) * kBorder, line + std::size_t(4) * (grid.columns - kBorder), kBorder);
        copy(line + std::size_t(4) * grid.columns, line, kBorder);
    }
    const int half = grid.columns / 2;
    for (int i = 0; i < kBorder; ++i)
        for (const bool south : {false, true}) {
            const float* from = row(grid, south ? grid.rings - 1 - i : i);
            float* to = row(grid, south ? grid.rings + i : -1 - i);
            // to[x] = from[x + half], for x from −border to columns + border
            copy(to - std::ptrdiff_t(4) * kBorder, from + std::size_t(4) * (half - kBorder), half + kBorder);
            copy(to + std::size_t(4) * half, from, half + kBorder);
        }
}

const Synthesis::FacePositions& Synthesis::positions(int n) {
    FacePositions& p = positions_[n];
    if (!p.side_u.empty()) return p;
    const auto coordinate = [n](int i) { return (2.0 * i + 1.0) / n - 1.0; };
    const std::size_t texels = std::size_t(n) * n;
    p.side_v.resize(texels);
    p.top_u.resize(texels);
    p.top_v.resize(texels);
    for (int x = 0; x < n; ++x) p.side_u.push_back(0.5 + std::atan2(1.0, coordinate(x)) / (2.0 * kPi));  // +X
    control_.parallel_for(n, [&](int y) {
        const double t = coordinate(y);
        for (int x = 0; x < n; ++x) {
            const double s = coordinate(x);
            const double r2 = s * s + t * t;
            p.side_v[std::size_t(y) * n + x] = 0.5 + std::atan(t / std::sqrt(1.0 + s * s)) / kPi;
            p.top_u[std::size_t(y) * n + x] = 0.5 + std::atan2(s, -t) / (2.0 * kPi);
            p.top_v[std::size_t(y) * n + x] = std::atan(std::sqrt(r2)) / kPi;
        }
    });
    return p;
}

void Synthesis::resample(const Grid& grid, const Range& range, CubeMap& cube) {
    const int n = cube.size;
    const FacePositions& p = positions(n);
    const float lowest[4] = {range.lowest.x, range.lowest.y, range.lowest.z, 0.0f};
    const float highest[4] = {range.highest.x, range.highest.y, range.highest.z, 0.0f};
    const simd::LagrangeSource source = {row(grid, 0), row_floats(grid), grid.columns, lowest, highest};
    const auto texel = [&](int face, int y) { return &cube.texels[(std::size_t(face) * n + y) * n].x; };
    enum Part { Sides, Top, Bottom };
    struct Coordinates {
        std::vector<double> x, y;
    };
    const auto make_coordinates = [n] { return Coordinates{std::vector<double>(n), std::vector<double>(n)}; };
    run_tasks(control_, 3 * n, make_coordinates, [&](int task, Coordinates& at) {
        const Part part = Part(task / n);
        const int y = task % n;
        const std::size_t from = std::size_t(part == Bottom ? n - 1 - y : y) * n;
        for (int x = 0; x < n; ++x) {
            const double u = part == Sides ? p.side_u[x] : p.top_u[from + x];
            const double v = part == Sides ? p.side_v[from + x] : p.top_v[from + x];
            at.x[x] = u * grid.columns;  // column k is at u = k/columns: the texels' half is in phase
            at.y[x] = (part == Bottom ? 1.0 - v : v) * grid.rings - 0.5;
        }
        float* out[4] = {texel(part == Sides ? 0 : part == Top ? 2 : 3, y), nullptr, nullptr, nullptr};
        if (part == Sides)
            out[1] = texel(4, y), out[2] = texel(1, y), out[3] = texel(5, y);  // a quarter turn each
        simd::interpolate_row(source, {n, at.x.data(), at.y.data(), part == Sides ? 4 : 1, out});
    });
}

}  // namespace patina
