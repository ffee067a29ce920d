// The labelled sheet: titles stay in their columns whatever they say.
#include "app/sheet.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

Image titled(const std::string& title) {
    Sheet sheet(2, 1, {96, 96}, PixelType::U8);
    sheet.set_column_title(0, title);
    return sheet.image();
}

TEST(Sheet, a_title_that_is_too_long_ends_in_an_ellipsis_inside_its_column) {
    const std::string text = "The lamp beside the kitchen’s window at half past five";
    const Image shown = titled(text), empty = titled("");
    EXPECT_NE(shown.bytes, empty.bytes);
    for (int y = 0; y < shown.height; ++y)
        for (int x = 4 + 96; x < shown.width; ++x)
            ASSERT_EQ(texel(shown, x, y, 0), texel(empty, x, y, 0)) << x << ", " << y;
    std::size_t end = 1;
    while (end < text.size() && titled(text.substr(0, end) + "…").bytes != shown.bytes) ++end;
    ASSERT_LT(end, text.size());
    EXPECT_NE(titled(text.substr(0, end)).bytes, shown.bytes) << "it is not just cut off there";
}

TEST(Sheet, a_title_that_fits_is_left_alone) {
    EXPECT_NE(titled("Studio").bytes, titled("Studi…").bytes);
    EXPECT_NE(titled("Studio").bytes, titled("Studio…").bytes);
}

}  // namespace
}  // namespace patina
