#include "renderer/core/color_difference.h"

#include <cmath>
#include <numbers>

namespace patina {

namespace {

constexpr double kPi = std::numbers::pi;

double lab_curve(double t) {
    constexpr double delta = 6.0 / 29.0;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

double radians(double degrees) { return degrees * kPi / 180.0; }

/// Length of (a, b); Lab's values are far from where squares overflow.
double length(double a, double b) { return std::sqrt(a * a + b * b); }

/// Hue in degrees 0…360; 0 for grey.
double hue(double a, double b) {
    if (a == 0.0 && b == 0.0) return 0.0;
    const double degrees = std::atan2(b, a) * 180.0 / kPi;
    return degrees < 0.0 ? degrees + 360.0 : degrees;
}

/// C^7/(C^7 + 25^7) under a root: how blue the region of neutral colours is taken.
double chroma_weight(double chroma) {
    const double square = chroma * chroma, power = square * square * square * chroma;
    return std::sqrt(power / (power + 6103515625.0));  // 25^7
}

struct HuePair {
    double difference;  ///< degrees, −180…180
    double mean;        ///< degrees
};
HuePair hues(double h1, double h2, bool grey) {
    if (grey) return {0.0, h1 + h2};
    const double difference = h2 - h1;
    if (std::abs(difference) <= 180.0) return {difference, 0.5 * (h1 + h2)};
    const double sum = h1 + h2;
    return {difference > 180.0 ? difference - 360.0 : difference + 360.0,
            sum < 360.0 ? 0.5 * (sum + 360.0) : 0.5 * (sum - 360.0)};
}

}  // namespace

float luminance(glm::vec3 linear) { return 0.2126f * linear.x + 0.7152f * linear.y + 0.0722f * linear.z; }

glm::vec3 lab_of(glm::vec3 linear) {
    const double r = double(linear.x), g = double(linear.y), b = double(linear.z);
    // IEC 61966-2-1, rows divided by the white point so that (1,1,1) is exactly white.
    const double x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / (0.4124 + 0.3576 + 0.1805);
    const double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const double z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / (0.0193 + 0.1192 + 0.9505);
    const double fx = lab_curve(x), fy = lab_curve(y), fz = lab_curve(z);
    return {float(116.0 * fy - 16.0), float(500.0 * (fx - fy)), float(200.0 * (fy - fz))};
}

float delta_e_2000(glm::vec3 lab_a, glm::vec3 lab_b) {
    const double l1 = double(lab_a.x), l2 = double(lab_b.x);
    const double mean_chroma =
        0.5 * (length(double(lab_a.y), double(lab_a.z)) + length(double(lab_b.y), double(lab_b.z)));
    const double stretch = 1.0 + 0.5 * (1.0 - chroma_weight(mean_chroma));
    const double a1 = stretch * double(lab_a.y), a2 = stretch * double(lab_b.y);
    const double c1 = length(a1, double(lab_a.z)), c2 = length(a2, double(lab_b.z));
    const HuePair h = hues(hue(a1, double(lab_a.z)), hue(a2, double(lab_b.z)), c1 * c2 == 0.0);
    const double dl = l2 - l1, dc = c2 - c1;
    const double dh = 2.0 * std::sqrt(c1 * c2) * std::sin(radians(0.5 * h.difference));
    const double l = 0.5 * (l1 + l2), c = 0.5 * (c1 + c2);
    const double t = 1.0 - 0.17 * std::cos(radians(h.mean - 30.0)) + 0.24 * std::cos(radians(2.0 * h.mean)) +
                     0.32 * std::cos(radians(3.0 * h.mean + 6.0)) -
                     0.20 * std::cos(radians(4.0 * h.mean - 63.0));
    const double blue = (h.mean - 275.0) / 25.0;
    const double turn = 30.0 * std::exp(-blue * blue);
    const double rotation = -2.0 * chroma_weight(c) * std::sin(radians(2.0 * turn));
    const double off_middle = (l - 50.0) * (l - 50.0);
    const double sl = 1.0 + 0.015 * off_middle / std::sqrt(20.0 + off_middle);
    const double sc = 1.0 + 0.045 * c, sh = 1.0 + 0.015 * c * t;
    const double el = dl / sl, ec = dc / sc, eh = dh / sh;
    return float(std::sqrt(el * el + ec * ec + eh * eh + rotation * ec * eh));
}

}  // namespace patina
