#include "renderer/ibl/fft.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace patina {
namespace {

constexpr double kPi = std::numbers::pi;

bool has_small_factors(int size) {
    for (const int prime : {2, 3, 5})
        while (size % prime == 0) size /= prime;
    return size == 1;
}

std::vector<int> factorise(int size) {
    std::vector<int> radices;
    for (; size % 4 == 0; size /= 4) radices.push_back(4);
    for (int prime = 2; size > 1; ++prime)
        for (; size % prime == 0; size /= prime) radices.push_back(prime);
    return radices;
}

/// A plain recursive transform in double, for tables only.
void transform(std::vector<std::complex<double>>& x) {
    const std::size_t n = x.size();
    std::size_t radix = 2;
    while (radix < n && n % radix != 0) ++radix;
    if (n <= 1) return;
    const std::size_t m = n / radix;
    std::vector<std::vector<std::complex<double>>> parts(radix, std::vector<std::complex<double>>(m));
    for (std::size_t i = 0; i < n; ++i) parts[i % radix][i / radix] = x[i];
    for (auto& part : parts) transform(part);
    for (std::size_t k = 0; k < n; ++k) {
        x[k] = 0.0;
        for (std::size_t r = 0; r < radix; ++r)
            x[k] += parts[r][k % m] * std::polar(1.0, -2.0 * kPi * double(r * k % n) / double(n));
    }
}

}  // namespace

FftPlan::FftPlan(int size) {
    assert(size > 0);
    view_.size = size;
    radices_ = factorise(size);
    if (!radices_.empty() && *std::max_element(radices_.begin(), radices_.end()) > kLargestRadix)
        plan_convolution();
    else
        plan_passes();
}

FftPlan::~FftPlan() = default;

int FftPlan::buffer_elements() const { return convolution_ ? convolution_->view_.size : view_.size; }

void FftPlan::plan_passes() {
    int length = view_.size;
    for (const int radix : radices_) {
        const int parts = length / radix;
        for (int p = 0; p < parts; ++p)
            for (int j = 1; j < radix; ++j) {
                const double angle = 2.0 * kPi * p * j / length;
                twiddles_.push_back(float(std::cos(angle)));
                twiddles_.push_back(float(-std::sin(angle)));
            }
        if (radix > 4) {
            for (int j = 0; j < radix; ++j) roots_.push_back(float(std::cos(2.0 * kPi * j / radix)));
            for (int j = 0; j < radix; ++j) roots_.push_back(float(-std::sin(2.0 * kPi * j / radix)));
        }
        length = parts;
    }
    view_.pass_count = int(radices_.size());
    view_.radices = radices_.data();
    view_.twiddles = twiddles_.data();
    view_.roots = roots_.data();
}

void FftPlan::plan_convolution() {
    const int n = view_.size;
    convolution_ = std::make_unique<FftPlan>(friendly_fft_size(2 * n - 1, 4));
    const int m = convolution_->view_.size;
    std::vector<std::complex<double>> conjugate(m);
    for (long long i = 0; i < n; ++i) {
        const double angle = kPi * double(i * i % (2LL * n)) / n;
        chirp_.push_back(float(std::cos(angle)));
        chirp_.push_back(float(-std::sin(angle)));
        conjugate[i] = std::polar(1.0, angle);
        if (i > 0) conjugate[m - i] = conjugate[i];
    }
    transform(conjugate);
    for (const std::complex<double>& value : conjugate) {
        chirp_spectrum_.push_back(float(value.real() / m));
        chirp_spectrum_.push_back(float(value.imag() / m));
    }
    view_.convolution = &convolution_->view_;
    view_.chirp = chirp_.data();
    view_.chirp_spectrum = chirp_spectrum_.data();
}

int friendly_fft_size(int minimum, int step) {
    int size = (minimum + step - 1) / step * step;
    while (!has_small_factors(size)) size += step;
    return size;
}

}  // namespace patina
