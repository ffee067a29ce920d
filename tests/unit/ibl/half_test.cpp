// Light as half floats: as one value alone is rounded, on every instruction set.
#include "renderer/gl/half.h"

#include "renderer/ibl/half_simd.h"
#include "renderer/ibl/sh_simd.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <hwy/targets.h>
#include <random>
#include <vector>

namespace patina {
namespace {

/// RGB: what halves can hold, their ends, halfway cases and random ones. Not a multiple of any vector.
std::vector<float> radiances() {
    std::vector<float> values{0.0f, -0.0f, 1.0f, 65504.0f, 0x1p-14f, 0x1p-24f, 0x1p-25f, 0x1p-26f};
    for (int i = 0; i < 64; ++i) {
        values.push_back(1.0f + float(i) * 0x1p-12f);
        values.push_back(float(i) * 0x1p-26f);
    }
    std::mt19937 random(5);
    std::uniform_real_distribution<float> exponent(-26.0f, 15.9f);
    while (values.size() % 3 != 0 || values.size() < 1400) values.push_back(std::exp2(exponent(random)));
    return values;
}

template <class Check>
void on_every_instruction_set(const Check& check) {
    for (std::int64_t targets = hwy::SupportedTargets(); targets != 0; targets &= targets - 1) {
        hwy::SetSupportedTargetsForTest(targets & -targets);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        SCOPED_TRACE(simd::instruction_set());
        check();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(Halves, of_many_texels_are_those_of_each_value) {
    const std::vector<float> rgb = radiances();
    const int all = int(rgb.size()) / 3;
    on_every_instruction_set([&] {
        for (const int count : {all, 1, 2, 7, 16, 33}) {
            std::vector<std::uint16_t> rgba(4 * std::size_t(count) + 1, 0xffff);
            simd::to_rgba_halves(rgb.data(), count, 0.5f, rgba.data());
            for (int i = 0; i < count; ++i) {
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(rgba[4 * i + c], gl::to_half(0.5f * rgb[3 * i + c])) << rgb[3 * i + c];
                ASSERT_EQ(rgba[4 * i + 3], 0x3c00);
            }
            ASSERT_EQ(rgba.back(), 0xffff) << "written beyond";
        }
    });
}

TEST(Halves, the_largest_is_found_wherever_it_stands) {
    on_every_instruction_set([] {
        for (const int count : {1, 3, 48, 150})
            for (int at = 0; at < count; ++at) {
                std::vector<float> values(std::size_t(count), 0.25f);
                values[at] = 7.0f;
                ASSERT_EQ(simd::largest_of(values.data(), count, 0.0f), 7.0f) << count << ", " << at;
            }
        EXPECT_EQ(simd::largest_of(nullptr, 0, 2.0f), 2.0f);
    });
}

TEST(Halves, are_read_back_as_they_were_written) {
    for (std::uint32_t bits = 0; bits < 0x10000; ++bits) {
        const auto half = std::uint16_t(bits);
        if ((half & 0x7c00) == 0x7c00) continue;  // infinite, or not a number
        ASSERT_EQ(gl::to_half(gl::from_half(half)), half);
    }
    EXPECT_EQ(gl::from_half(0x3c01), 1.0f + 0x1p-10f);
    EXPECT_EQ(gl::from_half(0x8001), -0x1p-24f);
}

}  // namespace
}  // namespace patina
