#include "app/ktx.h"

#include "renderer/gl/half.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace patina {

namespace {

constexpr float kLargestHalf = 65504.0f;
constexpr double kSmallestNormalHalf = 6.103515625e-5;
constexpr std::size_t kTexelBytes = 8;  ///< four halves
constexpr std::uint16_t kHalfOne = 0x3C00;

class ByteWriter {
public:
    void put8(unsigned value) { bytes_.push_back(std::byte(value & 0xFF)); }
    void put16(unsigned value) {
        put8(value);
        put8(value >> 8);
    }
    void put32(std::uint32_t value) {
        put16(value & 0xFFFF);
        put16(value >> 16);
    }
    void put64(std::uint64_t value) {
        put32(std::uint32_t(value));
        put32(std::uint32_t(value >> 32));
    }
    void put_text(std::string_view text) {
        for (const char c : text) put8(static_cast<unsigned char>(c));
    }
    void put_bytes(const std::vector<std::byte>& more) {
        bytes_.insert(bytes_.end(), more.begin(), more.end());
    }
    void align(std::size_t size) { bytes_.resize((bytes_.size() + size - 1) / size * size); }
    std::size_t size() const { return bytes_.size(); }
    std::vector<std::byte> take() { return std::move(bytes_); }

private:
    std::vector<std::byte> bytes_;
};

std::string decimal(float value) {
    std::array<char, 32> buffer{};
    return {buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr};
}

using KeyValue = std::pair<std::string, std::string>;  ///< the value as raw bytes

KeyValue text_value(std::string key, std::string value) {
    value.push_back('\0');
    return {std::move(key), std::move(value)};
}

std::vector<std::byte> key_value_bytes(const std::vector<KeyValue>& pairs) {
    ByteWriter out;
    for (const auto& [key, value] : pairs) {
        out.put32(std::uint32_t(key.size() + 1 + value.size()));
        out.put_text(key);
        out.put8(0);
        out.put_text(value);
        out.align(4);
    }
    return out.take();
}

std::string roughness_list(const BakedEnvironment& baked) {
    std::string text;
    for (const PrefilteredLevel& level : baked.levels)
        text += (text.empty() ? "" : " ") + decimal(level.roughness);
    return text;
}

/// One line a coefficient, "r g b", as Filament's cmgen writes it.
std::string coefficient_lines(const CubeMap& irradiance, float scale) {
    std::string text;
    for (const glm::vec3& c : irradiance_coefficients(irradiance))
        text += decimal(c.r * scale) + " " + decimal(c.g * scale) + " " + decimal(c.b * scale) + "\n";
    return text;
}

void put_texel(ByteWriter& out, glm::vec3 radiance) {
    for (int c = 0; c < 3; ++c) out.put16(gl::to_half(radiance[c]));
    out.put16(kHalfOne);
}

void put_level(ByteWriter& out, const CubeMap& cube, float scale, bool mirror_x) {
    for (int face = 0; face < 6; ++face) {
        const int from = mirror_x && face < 2 ? 1 - face : face;
        for (int y = 0; y < cube.size; ++y)
            for (int x = 0; x < cube.size; ++x)
                put_texel(out, scale * cube.texels[(std::size_t(from) * cube.size + y) * cube.size +
                                                   (mirror_x ? cube.size - 1 - x : x)]);
    }
}

std::uint64_t level_bytes(const CubeMap& cube) {
    return 6 * kTexelBytes * std::uint64_t(cube.size) * cube.size;
}

/// Khronos data format descriptor of four half floats, linear light with Rec. 709 primaries.
void put_format_descriptor(ByteWriter& out) {
    constexpr unsigned samples = 4;
    constexpr unsigned block_bytes = 24 + 16 * samples;
    out.put32(4 + block_bytes);
    out.put32(0);  // Khronos, basic format
    out.put16(2);  // version
    out.put16(block_bytes);
    for (const unsigned field : {1, 1, 1, 0}) out.put8(field);  // RGBSDA, BT.709, linear, straight alpha
    out.put32(0);                                               // one texel a block
    out.put8(kTexelBytes);
    for (int plane = 1; plane < 8; ++plane) out.put8(0);
    for (unsigned sample = 0; sample < samples; ++sample) {
        constexpr unsigned float_signed = 0xC0;
        constexpr unsigned alpha = 15;
        out.put16(16 * sample);
        out.put8(16 - 1);
        out.put8(float_signed | (sample == 3 ? alpha : sample));
        out.put32(0);           // position
        out.put32(0xBF800000);  // −1
        out.put32(0x3F800000);  // +1
    }
}

[[maybe_unused]] bool is_mip_chain(const BakedEnvironment& baked) {
    for (std::size_t k = 0; k < baked.levels.size(); ++k)
        if (baked.levels[k].cube.size != baked.levels[0].cube.size >> k) return false;
    return !baked.levels.empty() && baked.lights.empty();
}

}  // namespace

int ktx_mip_count(int base) {
    assert(base >= 4 && (base & (base - 1)) == 0);
    const int halvings = int(std::lround(std::log2(base)));
    return std::max(halvings - 3, std::min(halvings + 1, 5));
}

float ktx_roughness(int mip, int mip_count) {
    return mip_count < 2 ? 0.0f : float(1.0 - std::sqrt(1.0 - double(mip) / (mip_count - 1)));
}

std::optional<BakedEnvironment> bake_for_ktx(const Environment& environment, int base,
                                             const BakeControl& control) {
    BakeSettings settings{.roughness = {}, .max_face_size = std::min(base, 64), .face_sizes = {}};
    const int count = ktx_mip_count(base);
    for (int mip = 0; mip < count; ++mip) {
        settings.roughness.push_back(ktx_roughness(mip, count));
        settings.face_sizes.push_back(base >> mip);
    }
    return bake_environment(environment, settings, control);
}

std::array<glm::vec3, 9> irradiance_coefficients(const CubeMap& irradiance) {
    std::array<glm::dvec3, 9> projections{};
    std::array<double, 9> norms{};
    const int size = irradiance.size;
    for (int row = 0; row < 6 * size; ++row)
        for (int x = 0; x < size; ++x) {
            const glm::dvec3 n(cube_texel_direction(size, row / size, x, row % size));
            const double weight = cube_texel_solid_angle(size, x, row % size);
            const std::array<double, 9> basis{1.0,
                                              n.y,
                                              n.z,
                                              n.x,
                                              n.x * n.y,
                                              n.y * n.z,
                                              3.0 * n.z * n.z - 1.0,
                                              n.z * n.x,
                                              n.x * n.x - n.y * n.y};
            const glm::dvec3 light(irradiance.texels[std::size_t(row) * size + x]);
            for (std::size_t i = 0; i < basis.size(); ++i) {
                projections[i] += weight * basis[i] * light;
                norms[i] += weight * basis[i] * basis[i];
            }
        }
    std::array<glm::vec3, 9> coefficients{};
    for (std::size_t i = 0; i < coefficients.size(); ++i)
        coefficients[i] = glm::vec3(projections[i] / norms[i]);
    return coefficients;
}

int ktx_exponent(const BakedEnvironment& baked, const std::string& source) {
    float largest = 0.0f;
    double sum = 0.0;
    for (const PrefilteredLevel& level : baked.levels)
        for (const glm::vec3& texel : level.cube.texels)
            largest = std::max({largest, texel.r, texel.g, texel.b});
    for (const glm::vec3& texel : baked.levels.front().cube.texels)
        sum += double(texel.r) + texel.g + texel.b;
    const double mean = sum / (3.0 * double(baked.levels.front().cube.texels.size()));
    int exponent = 0;
    while (std::ldexp(largest, -exponent) > kLargestHalf) ++exponent;
    if (exponent > 0 && std::ldexp(mean, -exponent) < kSmallestNormalHalf)
        throw std::runtime_error(
            source + ": its brightest light is " + decimal(largest) +
            ", too bright beside the rest for the half floats of a KTX file; bake it with "
            "--format exr");
    return exponent;
}

std::vector<std::byte> to_ktx1(const BakedEnvironment& baked, int exponent) {
    assert(is_mip_chain(baked));
    const float scale = std::ldexp(1.0f, -exponent);
    const std::vector<std::byte> pairs = key_value_bytes(
        {text_value("KTXorientation", "S=r,T=d"), text_value("PatinaRoughness", roughness_list(baked)),
         text_value("PatinaScale", decimal(std::ldexp(1.0f, exponent))),
         text_value("sh", coefficient_lines(baked.irradiance, scale))});
    constexpr std::uint32_t half_float = 0x140B;
    constexpr std::uint32_t rgba = 0x1908;
    constexpr std::uint32_t rgba16f = 0x881A;
    const auto base = std::uint32_t(baked.levels.front().cube.size);
    ByteWriter out;
    out.put_text("\xABKTX 11\xBB\r\n\x1A\n");
    for (const std::uint32_t field : {std::uint32_t{0x04030201}, half_float, std::uint32_t{2}, rgba, rgba16f,
                                      rgba, base, base, std::uint32_t{0}, std::uint32_t{0}, std::uint32_t{6},
                                      std::uint32_t(baked.levels.size()), std::uint32_t(pairs.size())})
        out.put32(field);
    out.put_bytes(pairs);
    for (const PrefilteredLevel& level : baked.levels) {
        out.put32(std::uint32_t(level_bytes(level.cube) /
                                6));  // of one face, as for every cube map that is no array
        put_level(out, level.cube, scale, false);
    }
    return out.take();
}

std::vector<std::byte> to_ktx2(const BakedEnvironment& baked, int exponent) {
    assert(is_mip_chain(baked));
    std::vector<KeyValue> list;  // sorted by key
    if (exponent > 0) {
        std::string scale_and_offset(8, '\0');
        const float scale = std::ldexp(1.0f, exponent);
        const auto bits = std::bit_cast<std::uint32_t>(scale);
        for (std::size_t i = 0; i < 4; ++i) scale_and_offset[i] = static_cast<char>(bits >> (8 * i) & 0xFF);
        list.emplace_back("KTXmapRange", scale_and_offset);
    }
    list.push_back(text_value("KTXorientation", "rd"));
    list.push_back(text_value("KTXwriter", "Patina " PATINA_VERSION));
    list.push_back(text_value("PatinaRoughness", roughness_list(baked)));
    const std::vector<std::byte> pairs = key_value_bytes(list);
    constexpr std::uint32_t vk_format = 97;
    constexpr std::uint32_t header_bytes = 80;
    constexpr std::uint32_t level_index_bytes = 24;
    constexpr std::uint32_t descriptor_bytes = 92;
    const auto base = std::uint32_t(baked.levels.front().cube.size);
    const auto count = std::uint32_t(baked.levels.size());
    const std::uint32_t descriptor_at = header_bytes + level_index_bytes * count;
    const std::uint32_t pairs_at = descriptor_at + descriptor_bytes;
    ByteWriter out;
    out.put_text("\xABKTX 20\xBB\r\n\x1A\n");
    for (const std::uint32_t field :
         {vk_format, std::uint32_t{2}, base, base, std::uint32_t{0}, std::uint32_t{0}, std::uint32_t{6},
          count, std::uint32_t{0}, descriptor_at, descriptor_bytes, pairs_at, std::uint32_t(pairs.size())})
        out.put32(field);
    out.put64(0);  // no supercompression data
    out.put64(0);
    std::uint64_t at = (pairs_at + pairs.size() + kTexelBytes - 1) / kTexelBytes * kTexelBytes;
    std::vector<std::uint64_t> offsets(count);
    for (std::size_t k = count;
         k-- > 0;) {  // the smallest level stands first in the file, the largest in the index
        offsets[k] = at;
        at += level_bytes(baked.levels[k].cube);
    }
    for (std::size_t k = 0; k < count; ++k) {
        out.put64(offsets[k]);
        out.put64(level_bytes(baked.levels[k].cube));
        out.put64(level_bytes(baked.levels[k].cube));
    }
    put_format_descriptor(out);
    out.put_bytes(pairs);
    out.align(kTexelBytes);
    for (std::size_t k = count; k-- > 0;) {
        assert(out.size() == offsets[k]);
        put_level(out, baked.levels[k].cube, std::ldexp(1.0f, -exponent), true);
    }
    return out.take();
}

}  // namespace patina
