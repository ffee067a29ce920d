// A strict reader of half-float cube maps in KTX 1 and KTX 2 files, written from the two specifications and
// sharing nothing with the writer. Throws std::runtime_error at the first byte that is not as the
// specifications demand.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina::test {

struct KtxFile {
    int base = 0;
    std::vector<std::vector<float>> mips;  ///< RGBA, faces +X −X +Y −Y +Z −Z, rows from the first in the file
    std::map<std::string, std::string> values;
    const float* texel(int mip, int face, int x, int y) const {
        const int size = base >> mip;
        return mips[std::size_t(mip)].data() + 4 * ((std::size_t(face) * size + y) * size + x);
    }
};

class KtxBytes {
public:
    explicit KtxBytes(std::span<const std::byte> bytes) : bytes_(bytes) {}

    static void demand(bool condition, const std::string& what) {
        if (!condition) throw std::runtime_error("not a valid KTX file: " + what);
    }
    std::uint64_t get(int count) {
        demand(at_ + std::size_t(count) <= bytes_.size(), "it ends early");
        std::uint64_t value = 0;
        for (int i = 0; i < count; ++i) value |= std::to_integer<std::uint64_t>(bytes_[at_++]) << (8 * i);
        return value;
    }
    std::uint32_t get32() { return std::uint32_t(get(4)); }
    void expect(std::uint64_t value, int count, const std::string& field) {
        const std::uint64_t found = get(count);
        demand(found == value, field + " is " + std::to_string(found) + ", not " + std::to_string(value));
    }
    std::string text(std::size_t count) {
        std::string result;
        for (std::size_t i = 0; i < count; ++i) result.push_back(static_cast<char>(get(1)));
        return result;
    }
    void zeros_until(std::size_t offset, const std::string& what) {
        demand(offset >= at_, what + " overlaps what is before it");
        while (at_ < offset) expect(0, 1, what);
    }
    std::size_t at() const { return at_; }
    std::size_t size() const { return bytes_.size(); }

private:
    std::span<const std::byte> bytes_;
    std::size_t at_ = 0;
};

inline float half_value(std::uint16_t half) {
    const int exponent = half >> 10 & 31;
    const int fraction = half & 1023;
    KtxBytes::demand(exponent != 31, "a texel is infinite or no number");
    const float magnitude =
        exponent == 0 ? std::ldexp(float(fraction), -24) : std::ldexp(float(1024 + fraction), exponent - 25);
    return half & 0x8000 ? -magnitude : magnitude;
}

inline std::vector<float> read_level(KtxBytes& in, int size) {
    std::vector<float> level(std::size_t(24) * size * size);
    for (float& value : level) value = half_value(std::uint16_t(in.get(2)));
    for (std::size_t i = 3; i < level.size(); i += 4) KtxBytes::demand(level[i] == 1.0f, "alpha is not 1");
    return level;
}

inline std::map<std::string, std::string> read_values(KtxBytes& in, std::size_t length, bool sorted) {
    std::map<std::string, std::string> values;
    std::string last;
    const std::size_t end = in.at() + length;
    while (in.at() < end) {
        const std::uint32_t size = in.get32();
        KtxBytes::demand(size >= 2 && in.at() + size <= end, "a key/value pair is longer than its block");
        const std::string pair = in.text(size);
        const std::size_t nul = pair.find('\0');
        KtxBytes::demand(nul != std::string::npos && nul > 0, "a key is empty or not terminated");
        const std::string key = pair.substr(0, nul);
        KtxBytes::demand(values.emplace(key, pair.substr(nul + 1)).second,
                         "the key " + key + " appears twice");
        KtxBytes::demand(!sorted || last < key, "the keys are not sorted");
        last = key;
        in.zeros_until((in.at() + 3) / 4 * 4, "the padding of a value");
    }
    KtxBytes::demand(in.at() == end, "the key/value block has another length than promised");
    return values;
}

inline KtxFile read_ktx1(std::span<const std::byte> bytes) {
    KtxBytes in(bytes);
    KtxBytes::demand(in.text(12) == "\xABKTX 11\xBB\r\n\x1A\n", "identifier");
    in.expect(0x04030201, 4, "endianness");
    in.expect(0x140B, 4, "glType");  // HALF_FLOAT
    in.expect(2, 4, "glTypeSize");
    in.expect(0x1908, 4, "glFormat");          // RGBA
    in.expect(0x881A, 4, "glInternalFormat");  // RGBA16F
    in.expect(0x1908, 4, "glBaseInternalFormat");
    KtxFile file;
    file.base = int(in.get32());
    in.expect(std::uint64_t(file.base), 4, "pixelHeight");
    in.expect(0, 4, "pixelDepth");
    in.expect(0, 4, "numberOfArrayElements");
    in.expect(6, 4, "numberOfFaces");
    const std::uint32_t mips = in.get32();
    KtxBytes::demand(file.base >= 1 && file.base <= 16384, "pixelWidth");
    KtxBytes::demand(mips >= 1 && mips <= 15 && file.base >> (mips - 1) >= 1, "numberOfMipmapLevels");
    const std::uint32_t length = in.get32();
    KtxBytes::demand(length % 4 == 0, "bytesOfKeyValueData");
    file.values = read_values(in, length, false);
    for (std::uint32_t mip = 0; mip < mips; ++mip) {
        const int size = file.base >> mip;
        in.expect(8u * std::uint64_t(size) * size, 4, "imageSize");  // of one face
        file.mips.push_back(read_level(in, size));
    }
    KtxBytes::demand(in.at() == in.size(), "bytes follow the last level");
    return file;
}

inline void read_format_descriptor(KtxBytes& in) {
    in.expect(92, 4, "dfdTotalSize");
    in.expect(0, 4, "vendorId, descriptorType");
    in.expect(2, 2, "versionNumber");
    in.expect(24 + 4 * 16, 2, "descriptorBlockSize");
    in.expect(1, 1, "colorModel");        // KHR_DF_MODEL_RGBSDA
    in.expect(1, 1, "colorPrimaries");    // KHR_DF_PRIMARIES_BT709
    in.expect(1, 1, "transferFunction");  // KHR_DF_TRANSFER_LINEAR
    in.expect(0, 1, "flags");
    in.expect(0, 4, "texelBlockDimension");
    in.expect(8, 8, "bytesPlane0, and no other plane");
    for (const unsigned channel : {0u, 1u, 2u, 15u}) {
        const unsigned index = channel == 15 ? 3 : channel;
        in.expect(16 * index, 2, "bitOffset");
        in.expect(15, 1, "bitLength");
        in.expect(0xC0 | channel, 1, "channelType with FLOAT and SIGNED");
        in.expect(0, 4, "samplePosition");
        in.expect(std::bit_cast<std::uint32_t>(-1.0f), 4, "sampleLower");
        in.expect(std::bit_cast<std::uint32_t>(1.0f), 4, "sampleUpper");
    }
}

inline KtxFile read_ktx2(std::span<const std::byte> bytes) {
    KtxBytes in(bytes);
    KtxBytes::demand(in.text(12) == "\xABKTX 20\xBB\r\n\x1A\n", "identifier");
    in.expect(97, 4, "vkFormat");  // VK_FORMAT_R16G16B16A16_SFLOAT
    in.expect(2, 4, "typeSize");
    KtxFile file;
    file.base = int(in.get32());
    in.expect(std::uint64_t(file.base), 4, "pixelHeight");
    in.expect(0, 4, "pixelDepth");
    in.expect(0, 4, "layerCount");
    in.expect(6, 4, "faceCount");
    const std::uint32_t mips = in.get32();
    KtxBytes::demand(file.base >= 1 && file.base <= 16384, "pixelWidth");
    KtxBytes::demand(mips >= 1 && mips <= 15 && file.base >> (mips - 1) >= 1, "levelCount");
    in.expect(0, 4, "supercompressionScheme");
    const std::uint32_t descriptor_at = 80 + 24 * mips;
    in.expect(descriptor_at, 4, "dfdByteOffset");
    in.expect(92, 4, "dfdByteLength");
    in.expect(descriptor_at + 92, 4, "kvdByteOffset");
    const std::uint32_t values_length = in.get32();
    KtxBytes::demand(values_length > 0, "kvdByteLength");
    in.expect(0, 8, "sgdByteOffset");
    in.expect(0, 8, "sgdByteLength");
    std::vector<std::uint64_t> offsets;
    for (std::uint32_t mip = 0; mip < mips; ++mip) {
        const int size = file.base >> mip;
        offsets.push_back(in.get(8));
        in.expect(48u * std::uint64_t(size) * size, 8, "byteLength");
        in.expect(48u * std::uint64_t(size) * size, 8, "uncompressedByteLength");
    }
    KtxBytes::demand(in.at() == descriptor_at, "the level index has another length than promised");
    read_format_descriptor(in);
    file.values = read_values(in, values_length, true);
    file.mips.resize(mips);
    for (std::uint32_t mip = mips; mip-- > 0;) {  // the smallest first
        KtxBytes::demand(offsets[mip] % 8 == 0, "a level is not aligned to its texels");
        KtxBytes::demand(offsets[mip] - in.at() < 8, "more padding than needed before a level");
        in.zeros_until(offsets[mip], "mipPadding");
        file.mips[mip] = read_level(in, file.base >> mip);
    }
    KtxBytes::demand(in.at() == in.size(), "bytes follow the last level");
    return file;
}

}  // namespace patina::test
