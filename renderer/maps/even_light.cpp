#include "renderer/maps/even_light.h"

#include "renderer/core/least_squares.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace patina {

namespace {

constexpr int kCells = 96;
constexpr int kRounds = 5;
constexpr int kTerms = (kMaxEvenDegree + 1) * (kMaxEvenDegree + 2) / 2;

using Terms = std::array<double, kTerms>;

/// x^i y^j with i + j ≤ degree, x and y in −1…1; the constant first.
int fill_terms(double x, double y, int degree, Terms& terms) {
    int n = 0;
    for (int total = 0; total <= degree; ++total)
        for (int j = 0; j <= total; ++j) terms[std::size_t(n++)] = std::pow(x, total - j) * std::pow(y, j);
    return n;
}

struct Sample {
    Terms terms;
    double value = 0.0, weight = 1.0;
};

/// Weighted least squares by Cholesky's factors of the normal equations; a ridge of 1e-9 keeps them regular.
Terms fitted(const std::vector<Sample>& samples, int n) {
    std::array<std::array<double, kTerms>, kTerms> a{};
    Terms b{};
    for (const Sample& sample : samples)
        for (int i = 0; i < n; ++i) {
            const double weighted = sample.weight * sample.terms[i];
            b[i] += weighted * sample.value;
            for (int j = 0; j <= i; ++j) a[i][j] += weighted * sample.terms[j];
        }
    for (int i = 0; i < n; ++i) a[i][i] += 1e-9 * double(samples.size());
    return solve_symmetric(a, b, n);
}

double value_of(const Terms& polynomial, const Terms& terms, int n) {
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += polynomial[i] * terms[i];
    return sum;
}

void weigh(std::vector<Sample>& samples, const Terms& polynomial, int n) {
    std::vector<double> distances;
    distances.reserve(samples.size());
    for (const Sample& sample : samples)
        distances.push_back(std::abs(sample.value - value_of(polynomial, sample.terms, n)));
    std::vector<double> sorted = distances;
    const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double scale = std::max(1.4826 * *middle, 1e-6);
    for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i].weight = 1.0 / (1.0 + (distances[i] / scale) * (distances[i] / scale));
}

double centred(int i, int size) { return 2.0 * (i + 0.5) / size - 1.0; }

/// The means of the channel's logarithms over cells, with the polynomial's terms there.
std::vector<Sample> samples_of(const Colors& picture, int channel, double floor, int degree) {
    const int columns = std::min(kCells, picture.width), rows = std::min(kCells, picture.height);
    std::vector<Sample> samples(std::size_t(columns) * std::size_t(rows));
    std::vector<int> counts(samples.size());
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto cell = std::size_t(y * rows / picture.height) * std::size_t(columns) +
                              std::size_t(x * columns / picture.width);
            samples[cell].value += std::log(std::max(double(picture.at(x, y)[channel]), floor));
            ++counts[cell];
        }
    for (std::size_t cell = 0; cell < samples.size(); ++cell) {
        samples[cell].value /= counts[cell];
        fill_terms(centred(int(cell) % columns, columns), centred(int(cell) / columns, rows), degree,
                   samples[cell].terms);
    }
    return samples;
}

double mean_of(const Colors& picture, int channel) {
    double sum = 0.0;
    for (const glm::vec3& color : picture.values) sum += double(color[channel]);
    return sum / double(picture.values.size());
}

void even_channel(Colors& picture, int channel, int degree) {
    const double mean = mean_of(picture, channel);
    if (!(mean > 0.0)) return;
    std::vector<Sample> samples = samples_of(picture, channel, 1e-3 * mean, degree);
    Terms terms{};
    const int n = fill_terms(0.0, 0.0, degree, terms);
    Terms polynomial{};
    for (int round = 0; round < kRounds; ++round) {
        polynomial = fitted(samples, n);
        weigh(samples, polynomial, n);
    }
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            fill_terms(centred(x, picture.width), centred(y, picture.height), degree, terms);
            picture.at(x, y)[channel] /= float(std::exp(value_of(polynomial, terms, n)));
        }
    const double level = mean_of(picture, channel);
    for (glm::vec3& color : picture.values) color[channel] *= float(mean / level);
}

}  // namespace

Colors evened(const Colors& picture, int degree) {
    Colors result = picture;
    for (int channel = 0; degree > 0 && channel < 3; ++channel) even_channel(result, channel, degree);
    return result;
}

}  // namespace patina
