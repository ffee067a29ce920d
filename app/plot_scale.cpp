// Axes: ranges, ticks at 1/2/5 and decades, and how numbers are written.
#include "app/plot_drawing.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace patina {

namespace {

constexpr double kPadding = 0.05;  ///< of the data's extent, on both sides
constexpr int kMaxLabels = 9;      ///< on a logarithmic axis

std::string superscript(int exponent) {
    static constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = exponent < 0 ? "⁻" : "";
    for (const char digit : std::to_string(std::abs(exponent))) text += digits[std::size_t(digit - '0')];
    return text;
}

/// mantissa × 10^exponent; a mantissa of 1 is left out.
std::string power_of_ten(const std::string& mantissa, int exponent) {
    return (mantissa == "1" ? "10" : mantissa + "×10") + superscript(exponent);
}

std::string shortest(double value, std::chars_format format, int precision) {
    std::array<char, 64> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, precision).ptr;
    std::string text(buffer.data(), end);
    if (text.find('.') != std::string::npos) {
        text.erase(text.find_last_not_of('0') + 1);
        if (text.ends_with('.')) text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

/// digits significant ones; trailing zeros go.
std::string significant(double value, int digits) {
    if (value == 0.0) return "0";
    const std::string scientific = shortest(value, std::chars_format::scientific, digits - 1);
    const std::size_t e = scientific.find('e');
    int exponent = 0;
    const std::size_t first = e + (scientific[e + 1] == '+' ? 2 : 1);
    std::from_chars(scientific.data() + first, scientific.data() + scientific.size(), exponent);
    if (exponent < -4 || exponent > 5) {
        double mantissa = 0.0;
        std::from_chars(scientific.data(), scientific.data() + e, mantissa);
        return power_of_ten(shortest(mantissa, std::chars_format::fixed, digits - 1), exponent);
    }
    double rounded = 0.0;  // 1234.5 to three digits is 1230
    std::from_chars(scientific.data(), scientific.data() + scientific.size(), rounded);
    return shortest(rounded, std::chars_format::fixed, std::max(0, digits - 1 - exponent));
}

PlotScale log_scale(double low, double high) {
    PlotScale scale{.log = true};
    const double padding =
        std::max(kPadding * (std::log10(high) - std::log10(low)), low == high ? 0.35 : 0.08);
    scale.low = std::pow(10.0, std::log10(low) - padding);
    scale.high = std::pow(10.0, std::log10(high) + padding);
    const double decades = std::log10(scale.high / scale.low);
    const int first = int(std::floor(std::log10(scale.low)));
    const int last = int(std::ceil(std::log10(scale.high)));
    const int decade_step = std::max(1, int(std::ceil(decades / kMaxLabels)));
    for (int exponent = first; exponent <= last; ++exponent)
        for (int digit = 1; digit < 10; ++digit) {
            const double value = digit * std::pow(10.0, exponent);
            if (value < scale.low || value > scale.high) continue;
            const bool one = digit == 1 && exponent % decade_step == 0;
            const bool two_or_five = (digit == 2 || digit == 5) && decades <= 3.2;
            const bool any = decades <= 0.8 && digit != 7 && digit != 9;
            if (decade_step > 1 && !one) continue;  // no minor grid over more decades than can be told apart
            scale.ticks.push_back({value, one || two_or_five || any ? significant(value, 1) : ""});
        }
    return scale;
}

PlotScale linear_scale(double low, double high) {
    PlotScale scale;
    const bool from_zero = low >= 0.0 && low <= 0.6 * high;
    const bool to_zero = high <= 0.0 && high >= 0.6 * low;
    double extent = (to_zero ? 0.0 : high) - (from_zero ? 0.0 : low);
    if (extent <= 1e-9 * std::max(std::abs(low), std::abs(high)))
        extent = std::max(std::abs(high), 1e-300) * 0.5;
    scale.low = from_zero ? 0.0 : low - kPadding * extent;
    scale.high = to_zero ? 0.0 : high + kPadding * extent;
    if (scale.high <= scale.low) scale.high = scale.low + 1.0;
    const double rough = (scale.high - scale.low) / 7.0;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    const double unit = rough / power;
    const int digit = unit <= 1.0 ? 1 : unit <= 2.0 ? 2 : unit <= 5.0 ? 5 : 10;
    const int parts = digit == 2 ? 4 : 5;  // the minor grid stands at round values too
    const double step = digit * power;
    const double minor = step / parts;
    const auto first = std::int64_t(std::ceil(scale.low / minor - 1e-9));
    const auto last = std::int64_t(std::floor(scale.high / minor + 1e-9));
    const int digits =
        1 +
        std::max(0, int(std::ceil(std::log10(std::max(std::abs(scale.low), std::abs(scale.high)) / step))));
    for (std::int64_t i = first; i <= last; ++i) {
        const double value = double(i) * minor;
        scale.ticks.push_back({value, i % parts == 0 ? significant(value, digits) : ""});
    }
    return scale;
}

}  // namespace

double PlotScale::position(double value) const {
    if (log) return std::log(value / low) / std::log(high / low);
    return (value - low) / (high - low);
}

bool drawable(const PlotAxis& axis, double value) {
    return std::isfinite(value) && (!axis.log || value > 0.0);
}

PlotScale make_scale(bool log, const std::vector<double>& values) {
    if (values.empty()) return log ? log_scale(0.1, 10.0) : linear_scale(0.0, 1.0);
    const auto [low, high] = std::ranges::minmax(values);
    return log ? log_scale(low, high) : linear_scale(low, high);
}

std::string plot_number(double value) { return significant(value, 3); }

}  // namespace patina
