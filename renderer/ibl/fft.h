// Plans for complex fast Fourier transforms of many independent signals at once, one signal a vector lane.
// Knows no vector instructions: the passes are in simd-inl.h.
#pragma once

#include <memory>
#include <vector>

namespace patina {

/// What the vector code needs of a plan, plain pointers only.
struct FftView {
    int size = 0;
    int pass_count = 0;
    const int* radices = nullptr;
    const float* twiddles = nullptr;  ///< of all passes in the order they are used, (cos, −sin) pairs
    const float* roots = nullptr;     ///< r cosines then r negative sines for each pass of generic radix r
    const FftView* convolution = nullptr;  ///< set where Bluestein's algorithm is used
    const float* chirp = nullptr;          ///< (cos, −sin) of πi²/size
    const float* chirp_spectrum =
        nullptr;  ///< of the convolution with the conjugate chirp, already divided by its size
};

/// The forward transform X_k = Σ x_j e^(−2πijk/n). Sizes whose prime factors are small go by Stockham's
/// autosort passes of radix 4, 3, 2 and generic odd radices; others by Bluestein's chirp convolution (1970),
/// itself of a size 2ᵃ3ᵇ5ᶜ.
class FftPlan {
public:
    explicit FftPlan(int size);
    FftPlan(const FftPlan&) = delete;
    FftPlan& operator=(const FftPlan&) = delete;
    FftPlan(FftPlan&&) = delete;
    FftPlan& operator=(FftPlan&&) = delete;
    ~FftPlan();

    const FftView& view() const { return view_; }
    /// Complex elements each of the two work buffers must hold.
    int buffer_elements() const;

    static constexpr int kLargestRadix = 31;

private:
    void plan_passes();
    void plan_convolution();

    FftView view_;
    std::vector<int> radices_;
    std::vector<float> twiddles_, roots_, chirp_, chirp_spectrum_;
    std::unique_ptr<FftPlan> convolution_;
};

/// The smallest size ≥ minimum that is a multiple of step and has no prime factor above 5.
int friendly_fft_size(int minimum, int step);

}  // namespace patina
