// The passes of FftPlan over vectors: element i of a signal is a vector of real parts and a vector of
// imaginary parts, one lane a signal. Included once for every instruction set.
#if defined(PATINA_FFT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef PATINA_FFT_INL_H
#undef PATINA_FFT_INL_H
#else
#define PATINA_FFT_INL_H
#endif

#include "renderer/ibl/fft.h"

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace patina::simd::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Singles = hn::ScalableTag<float>;
using Single = hn::Vec<Singles>;
constexpr int kLanes = int(hn::MaxLanes(Singles()));

struct Complex {
    Single re, im;
};
HWY_INLINE Complex load(const float* at) {
    return {hn::Load(Singles(), at), hn::Load(Singles(), at + kLanes)};
}
HWY_INLINE void store(Complex z, float* at) {
    hn::Store(z.re, Singles(), at);
    hn::Store(z.im, Singles(), at + kLanes);
}
HWY_INLINE Complex operator+(Complex a, Complex b) { return {hn::Add(a.re, b.re), hn::Add(a.im, b.im)}; }
HWY_INLINE Complex operator-(Complex a, Complex b) { return {hn::Sub(a.re, b.re), hn::Sub(a.im, b.im)}; }
/// z · (w[0] + i w[1])
HWY_INLINE Complex times(Complex z, const float* w) {
    const Single c = hn::Set(Singles(), w[0]), s = hn::Set(Singles(), w[1]);
    return {hn::NegMulAdd(z.im, s, hn::Mul(z.re, c)), hn::MulAdd(z.im, c, hn::Mul(z.re, s))};
}
HWY_INLINE Complex times_minus_i(Complex z) { return {z.im, hn::Neg(z.re)}; }
HWY_INLINE Complex swapped(Complex z) { return {z.im, z.re}; }

/// A Stockham pass takes sub-transforms of length radix · parts, interleaved by stride, one radix further.
struct Pass {
    int parts, stride;
    const float* twiddles;
    const float* from;
    float* to;
    const float* in(int p, int q, int j) const {
        return from + std::size_t(2 * kLanes) * (std::size_t(stride) * (p + std::size_t(j) * parts) + q);
    }
    float* out(int p, int q, int k, int radix) const {
        return to + std::size_t(2 * kLanes) * (std::size_t(stride) * (std::size_t(radix) * p + k) + q);
    }
};

HWY_INLINE void radix4(const Pass& pass) {
    const float* w = pass.twiddles;
    for (int p = 0; p < pass.parts; ++p, w += 6)
        for (int q = 0; q < pass.stride; ++q) {
            const Complex a = load(pass.in(p, q, 0)), b = load(pass.in(p, q, 1));
            const Complex c = load(pass.in(p, q, 2)), d = load(pass.in(p, q, 3));
            const Complex sum = a + c, difference = a - c, other = b + d, turned = times_minus_i(b - d);
            store(sum + other, pass.out(p, q, 0, 4));
            store(times(difference + turned, w), pass.out(p, q, 1, 4));
            store(times(sum - other, w + 2), pass.out(p, q, 2, 4));
            store(times(difference - turned, w + 4), pass.out(p, q, 3, 4));
        }
}

HWY_INLINE void radix2(const Pass& pass) {
    const float* w = pass.twiddles;
    for (int p = 0; p < pass.parts; ++p, w += 2)
        for (int q = 0; q < pass.stride; ++q) {
            const Complex a = load(pass.in(p, q, 0)), b = load(pass.in(p, q, 1));
            store(a + b, pass.out(p, q, 0, 2));
            store(times(a - b, w), pass.out(p, q, 1, 2));
        }
}

HWY_INLINE void radix3(const Pass& pass) {
    const Single half = hn::Set(Singles(), 0.5f), root = hn::Set(Singles(), 0.866025403784438647f);
    const float* w = pass.twiddles;
    for (int p = 0; p < pass.parts; ++p, w += 4)
        for (int q = 0; q < pass.stride; ++q) {
            const Complex a = load(pass.in(p, q, 0)), b = load(pass.in(p, q, 1)), c = load(pass.in(p, q, 2));
            const Complex sum = b + c, difference = b - c;
            const Complex middle = {hn::NegMulAdd(half, sum.re, a.re), hn::NegMulAdd(half, sum.im, a.im)};
            const Complex turned =
                times_minus_i({hn::Mul(root, difference.re), hn::Mul(root, difference.im)});
            store(a + sum, pass.out(p, q, 0, 3));
            store(times(middle + turned, w), pass.out(p, q, 1, 3));
            store(times(middle - turned, w + 2), pass.out(p, q, 2, 3));
        }
}

/// Any odd radix: inputs j and r − j are paired, so outputs k and r − k share their products.
HWY_INLINE void radix_odd(const Pass& pass, int radix, const float* roots) {
    Complex even[FftPlan::kLargestRadix / 2 + 1], odd[FftPlan::kLargestRadix / 2 + 1];
    const float* w = pass.twiddles;
    const int half = radix / 2;
    for (int p = 0; p < pass.parts; ++p, w += std::ptrdiff_t(2) * (radix - 1))
        for (int q = 0; q < pass.stride; ++q) {
            const Complex first = load(pass.in(p, q, 0));
            Complex sum = first;
            for (int j = 1; j <= half; ++j) {
                const Complex a = load(pass.in(p, q, j)), b = load(pass.in(p, q, radix - j));
                even[j] = a + b;
                odd[j] = a - b;
                sum = sum + even[j];
            }
            store(sum, pass.out(p, q, 0, radix));
            for (int k = 1; k <= half; ++k) {
                Complex symmetric = first;
                Complex skew = {hn::Zero(Singles()), hn::Zero(Singles())};
                for (int j = 1, turn = k; j <= half; ++j, turn = (turn + k) % radix) {
                    const Single c = hn::Set(Singles(), roots[turn]),
                                 s = hn::Set(Singles(), roots[radix + turn]);
                    symmetric = {hn::MulAdd(even[j].re, c, symmetric.re),
                                 hn::MulAdd(even[j].im, c, symmetric.im)};
                    skew = {hn::NegMulAdd(odd[j].im, s, skew.re), hn::MulAdd(odd[j].re, s, skew.im)};
                }
                store(times(symmetric + skew, w + std::ptrdiff_t(2) * (k - 1)), pass.out(p, q, k, radix));
                store(times(symmetric - skew, w + std::ptrdiff_t(2) * (radix - k - 1)),
                      pass.out(p, q, radix - k, radix));
            }
        }
}

/// Transforms x, using y; the result is in the one that is returned.
HWY_INLINE float* run_passes(const FftView& plan, float* x, float* y) {
    Pass pass = {plan.size, 1, plan.twiddles, x, y};
    const float* roots = plan.roots;
    for (int i = 0; i < plan.pass_count; ++i) {
        const int radix = plan.radices[i];
        pass.parts /= radix;
        pass.from = x;
        pass.to = y;
        switch (radix) {
            case 4:
                radix4(pass);
                break;
            case 2:
                radix2(pass);
                break;
            case 3:
                radix3(pass);
                break;
            default:
                radix_odd(pass, radix, roots);
                roots += std::ptrdiff_t(2) * radix;
        }
        pass.twiddles += std::size_t(2) * (radix - 1) * pass.parts;
        pass.stride *= radix;
        float* previous = x;
        x = y;
        y = previous;
    }
    return x;
}

/// jk = (j² + k² − (k − j)²)/2 turns the transform into a convolution with a chirp (Bluestein 1970). The
/// inverse transform is the forward one with real and imaginary parts swapped before and after.
HWY_INLINE float* run_bluestein(const FftView& plan, float* x, float* y) {
    const std::size_t step = std::size_t(2) * kLanes;
    const int n = plan.size, m = plan.convolution->size;
    for (int i = 0; i < n; ++i)
        store(times(load(x + step * i), plan.chirp + std::ptrdiff_t(2) * i), x + step * i);
    for (int i = n; i < m; ++i) store({hn::Zero(Singles()), hn::Zero(Singles())}, x + step * i);
    float* z = run_passes(*plan.convolution, x, y);
    for (int i = 0; i < m; ++i)
        store(swapped(times(load(z + step * i), plan.chirp_spectrum + std::ptrdiff_t(2) * i)), z + step * i);
    z = run_passes(*plan.convolution, z, z == x ? y : x);
    for (int i = 0; i < n; ++i)
        store(times(swapped(load(z + step * i)), plan.chirp + std::ptrdiff_t(2) * i), z + step * i);
    return z;
}

HWY_INLINE float* run_fft(const FftView& plan, float* x, float* y) {
    return plan.convolution ? run_bluestein(plan, x, y) : run_passes(plan, x, y);
}

}  // namespace patina::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
