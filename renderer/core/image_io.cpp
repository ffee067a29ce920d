#include "renderer/core/image_io.h"

#include "renderer/core/file_io.h"
#include "renderer/core/image_format.h"
#include "renderer/core/radiance_hdr.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/sysutil.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <exception>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace patina {
namespace {

namespace fs = std::filesystem;
using Bytes = std::span<const std::byte>;

/// More bytes of a header than any of the formats needs to be told apart; a Radiance header is read from them
/// alone.
constexpr std::uint64_t kProbeBytes = 1 << 16;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
    throw std::runtime_error(path_text(file) + ": " + what);
}

/// The library's own words: on one line, without the closing stop.
std::string one_line(std::string text) {
    const std::size_t end = text.find_last_not_of(" \n\r\t.");
    text.resize(end == std::string::npos ? 0 : end + 1);
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c) != 0; }, ' ');
    constexpr std::size_t longest = 160;
    if (text.size() > longest) text.resize(longest);
    return text.empty() ? "no reason given" : text;
}

[[noreturn]] void fail_damaged(const fs::path& file, const std::string& reason) {
    fail(file, "is damaged (" + one_line(reason) + "); copy or export it again");
}

/// Runs a piece of work in which the library may throw, or ask for more memory than there is.
template <class Work>
auto guarded(const fs::path& file, Work work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        fail(file, "does not fit into memory; scale it down");
    } catch (const std::runtime_error&) {
        throw;
    } catch (const std::exception& error) {
        fail_damaged(file, error.what());
    }
}

/// Once a process: decoding stays on the calling thread, but for OpenEXR's blocks, whose unpacking a few
/// helpers share; no plug-ins come in from elsewhere.
void configure_library() {
    static const bool done = [] {
        OIIO::attribute("threads", 1);
        OIIO::attribute("exr_threads", std::min(4, static_cast<int>(OIIO::Sysutil::hardware_concurrency())));
        OIIO::attribute("plugin_searchpath", "");
        return true;
    }();
    static_cast<void>(done);
}

PixelType pixel_type_of(const OIIO::TypeDesc& format) {
    switch (format.basetype) {
        case OIIO::TypeDesc::UINT8:
            return PixelType::U8;
        case OIIO::TypeDesc::UINT16:
            return PixelType::U16;
        default:
            return PixelType::F32;
    }
}

OIIO::TypeDesc type_desc_of(PixelType type) {
    switch (type) {
        case PixelType::U8:
            return OIIO::TypeDesc::UINT8;
        case PixelType::U16:
            return OIIO::TypeDesc::UINT16;
        case PixelType::F32:
            break;
    }
    return OIIO::TypeDesc::FLOAT;
}

// --- which part and which channels ---

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// Index of the channel with one of those names (any case), -1 where there is none.
int channel_named(const OIIO::ImageSpec& spec, std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names)
        for (int i = 0; i < spec.nchannels; ++i)
            if (lower(spec.channelnames[i]) == name) return i;
    return -1;
}

/// What is read from one part of a file.
struct Selection {
    int part = 0;
    std::vector<int> channels;
    int rank = 0;  ///< 3: R, G, B; 2: luminance; 1: whatever comes first
};

Selection select_channels(const OIIO::ImageSpec& spec, int part) {
    Selection selection{.part = part, .rank = 1};
    const std::array<int, 3> rgb{channel_named(spec, {"r", "red"}), channel_named(spec, {"g", "green"}),
                                 channel_named(spec, {"b", "blue"})};
    const int luminance = channel_named(spec, {"y", "l"});
    const int alpha = channel_named(spec, {"a", "alpha"});
    if (std::all_of(rgb.begin(), rgb.end(), [](int i) { return i >= 0; })) {
        selection = {.part = part, .channels = {rgb.begin(), rgb.end()}, .rank = 3};
    } else if (luminance >= 0) {
        selection = {.part = part, .channels = {luminance}, .rank = 2};
    } else {
        selection.channels.resize(static_cast<std::size_t>(std::min(spec.nchannels, 4)));
        std::iota(selection.channels.begin(), selection.channels.end(), 0);
        return selection;
    }
    if (alpha >= 0) selection.channels.push_back(alpha);
    return selection;
}

/// Parts of one file: only an EXR's are alternatives; a TIFF's or a JPEG's further ones are pages and
/// previews.
Selection select_part(OIIO::ImageInput& input, ImageFormat format) {
    Selection best = select_channels(input.spec(0), 0);
    if (format != ImageFormat::OpenExr) return best;
    for (int part = 1; part < 64 && best.rank < 3; ++part) {
        const OIIO::ImageSpec spec = input.spec(part);
        if (spec.format == OIIO::TypeDesc::UNKNOWN) break;
        const Selection other = select_channels(spec, part);
        if (other.rank > best.rank) best = other;
    }
    return best;
}

// --- opening ---

/// An open decoder, over bytes in memory or over the file itself.
struct Decoder {
    std::unique_ptr<OIIO::Filesystem::IOMemReader> memory;
    std::unique_ptr<OIIO::ImageInput> input;
    ImageFormat format = ImageFormat::Unknown;
    Selection selection;
    OIIO::ImageSpec spec;  ///< of the selected part
};

ImageFormat known_format(const fs::path& file, Bytes bytes) {
    if (bytes.empty()) fail(file, "is empty; copy or export it again");
    const ImageFormat format = image_format_of(bytes);
    if (format == ImageFormat::Unknown)
        fail(file, "is not a PNG, JPEG, TIFF, TGA, BMP, EXR or HDR picture; convert it to one of these");
    return format;
}

void check_size(const fs::path& file, std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1) fail(file, "has no pixels; export it again");
    if (width > kMaxImageSide || height > kMaxImageSide || width * height > kMaxImagePixels)
        fail(file, "promises " + std::to_string(width) + "×" + std::to_string(height) +
                       " pixels, more than 16384×16384; scale it down");
}

void check_promise(const fs::path& file, ImageFormat format, Bytes bytes) {
    if (const auto size = promised_size(format, bytes)) check_size(file, size->width, size->height);
}

void check_spec(const fs::path& file, const Decoder& decoder) {
    const OIIO::ImageSpec& spec = decoder.spec;
    check_size(file, spec.width, spec.height);
    if (decoder.format == ImageFormat::OpenExr) check_size(file, spec.full_width, spec.full_height);
    if (spec.nchannels < 1) fail(file, "has no channels; export it again");
    if (spec.deep) fail(file, "holds deep data; flatten it");
    if (spec.depth > 1) fail(file, "is a volume; export one slice of it");
}

/// memory is empty where the file itself is to be read.
Decoder open_decoder(const fs::path& file, ImageFormat format, Bytes memory) {
    configure_library();
    Decoder decoder{.format = format};
    const std::string id(image_format_id(format));
    decoder.input = OIIO::ImageInput::create(id);
    if (!decoder.input)
        fail(file, "cannot be decoded by the installed OpenImageIO (" + one_line(OIIO::geterror()) +
                       "); convert it to PNG");
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    if (!memory.empty()) {
        decoder.memory = std::make_unique<OIIO::Filesystem::IOMemReader>(memory.data(), memory.size());
        OIIO::Filesystem::IOProxy* proxy = decoder.memory.get();
        config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    }
    OIIO::ImageSpec first;
    if (!decoder.input->open(memory.empty() ? path_text(file) : "memory." + id, first, config))
        fail_damaged(file, decoder.input->geterror());
    decoder.selection = select_part(*decoder.input, format);
    decoder.spec = decoder.input->spec(decoder.selection.part);
    check_spec(file, decoder);
    return decoder;
}

/// EXIF orientation that is still to be applied. A TGA's reader has applied it.
int orientation_of(const Decoder& decoder) {
    return decoder.format == ImageFormat::Targa ? 1 : decoder.spec.get_int_attribute("Orientation", 1);
}

bool fills_display_window(const OIIO::ImageSpec& spec) {
    return spec.x == spec.full_x && spec.y == spec.full_y && spec.width == spec.full_width &&
           spec.height == spec.full_height;
}

ImageInfo info_of(const Decoder& decoder) {
    const bool exr = decoder.format == ImageFormat::OpenExr;
    ImageInfo info{.width = exr ? decoder.spec.full_width : decoder.spec.width,
                   .height = exr ? decoder.spec.full_height : decoder.spec.height,
                   .channels = static_cast<int>(decoder.selection.channels.size()),
                   .type = pixel_type_of(decoder.spec.format),
                   .format = std::string(image_format_id(decoder.format))};
    if (orientation_of(decoder) >= 5) std::swap(info.width, info.height);
    return info;
}

// --- reading ---

/// Channels `wanted` of the selected part. Neighbouring channels are read at once, straight to where they
/// stay.
Image read_channels(const fs::path& file, const Decoder& decoder) {
    const OIIO::ImageSpec& spec = decoder.spec;
    const std::vector<int>& wanted = decoder.selection.channels;
    const PixelType type = pixel_type_of(spec.format);
    Image image = make_image(spec.width, spec.height, static_cast<int>(wanted.size()), type);
    const auto pixel_size = static_cast<OIIO::stride_t>(wanted.size() * bytes_per_channel(type));
    for (std::size_t first = 0; first < wanted.size();) {
        std::size_t end = first + 1;
        while (end < wanted.size() && wanted[end] == wanted[end - 1] + 1) ++end;
        if (!decoder.input->read_image(
                decoder.selection.part, 0, wanted[first], wanted[end - 1] + 1, type_desc_of(type),
                image.bytes.data() + first * bytes_per_channel(type), pixel_size, pixel_size * spec.width))
            fail_damaged(file, decoder.input->geterror());
        first = end;
    }
    return image;
}

void note_selection(const Decoder& decoder, std::vector<std::string>& notes) {
    const OIIO::ImageSpec& spec = decoder.spec;
    if (decoder.selection.part > 0)
        notes.push_back("part " + std::to_string(decoder.selection.part + 1) + " (\"" +
                        std::string(spec.get_string_attribute("oiio:subimagename")) +
                        "\") was read, the first one with colours");
    if (static_cast<std::size_t>(spec.nchannels) == decoder.selection.channels.size()) return;
    std::string kept;
    for (const int channel : decoder.selection.channels)
        kept += (kept.empty() ? "" : ", ") + spec.channelnames[channel];
    notes.push_back("of " + std::to_string(spec.nchannels) + " channels these were read: " + kept);
}

void note_extension(const fs::path& file, ImageFormat format, std::vector<std::string>& notes) {
    const std::string extension = path_text(file.extension());
    if (image_format_of_extension(extension) != format)
        notes.push_back("is a picture of the kind \"" + std::string(image_format_id(format)) +
                        "\" in spite of its name");
}

LoadedImage load_radiance(const fs::path& file, Bytes bytes) {
    const RadianceHeader header = parse_radiance_header(bytes);
    if (!header.problem.empty()) fail(file, header.problem);
    check_size(file, header.width, header.height);
    RadiancePicture picture = parse_radiance_pixels(bytes, header);
    if (!picture.problem.empty()) fail(file, picture.problem);
    return {.image = std::move(picture.image), .notes = std::move(picture.notes)};
}

LoadedImage load_decoded(const fs::path& file, ImageFormat format, Bytes bytes) {
    if (const std::string problem = image_structure_problem(format, bytes); !problem.empty())
        fail(file, problem);
    check_promise(file, format, bytes);
    const Decoder decoder = open_decoder(file, format, bytes);
    const OIIO::ImageSpec& spec = decoder.spec;
    // An EXR's display window is allocated, too, whatever its pixels cover.
    const auto can_hold_all = [&](int width, int height) {
        return can_hold(format, bytes.size(), static_cast<std::uint64_t>(width) * height);
    };
    if (!can_hold_all(spec.width, spec.height) ||
        (format == ImageFormat::OpenExr && !can_hold_all(spec.full_width, spec.full_height)))
        fail(file, "promises more pixels than it holds; copy or export it again");
    LoadedImage loaded{.image = read_channels(file, decoder)};
    note_selection(decoder, loaded.notes);
    if (format == ImageFormat::OpenExr && !fills_display_window(spec)) {
        loaded.image = placed(loaded.image, {.x = spec.x - spec.full_x,
                                             .y = spec.y - spec.full_y,
                                             .width = spec.full_width,
                                             .height = spec.full_height});
        loaded.notes.emplace_back(
            "its pixels do not cover the display window exactly; the rest was filled with black or cut off");
    }
    loaded.image = oriented(std::move(loaded.image), orientation_of(decoder));
    return loaded;
}

}  // namespace

ImageInfo load_image_info(const fs::path& file) {
    return guarded(file, [&]() -> ImageInfo {
        const std::vector<std::byte> start = read_file(file, kProbeBytes);
        const ImageFormat format = known_format(file, start);
        check_promise(file, format, start);
        if (format != ImageFormat::Hdr) return info_of(open_decoder(file, format, {}));
        const RadianceHeader header = parse_radiance_header(start);
        if (!header.problem.empty()) fail(file, header.problem);
        check_size(file, header.width, header.height);
        return {.width = static_cast<int>(header.width),
                .height = static_cast<int>(header.height),
                .channels = 3,
                .type = PixelType::F32,
                .format = "hdr"};
    });
}

LoadedImage load_image(const fs::path& file) {
    return guarded(file, [&] {
        const std::vector<std::byte> bytes = read_file(file);
        const ImageFormat format = known_format(file, bytes);
        LoadedImage loaded =
            format == ImageFormat::Hdr ? load_radiance(file, bytes) : load_decoded(file, format, bytes);
        note_extension(file, format, loaded.notes);
        return loaded;
    });
}

ImageMetadata load_image_metadata(const fs::path& file) {
    return guarded(file, [&] {
        ImageMetadata metadata;
        const ImageFormat format = known_format(file, read_file(file, kProbeBytes));
        if (format == ImageFormat::Hdr) return metadata;
        const Decoder decoder = open_decoder(file, format, {});
        for (const OIIO::ParamValue& row : decoder.spec.extra_attribs)
            if (!row.name().string().starts_with("oiio:"))
                metadata.emplace_back(row.name().string(), row.get_string());
        return metadata;
    });
}

// --- writing ---

namespace {

void check_savable(const fs::path& file, const Image& image, ImageFormat format) {
    if (format != ImageFormat::Png && format != ImageFormat::OpenExr)
        fail(file, "a picture is saved as .png or .exr; choose one of these extensions");
    if (image.empty()) fail(file, "there are no pixels to save; render the picture first");
    if ((format == ImageFormat::OpenExr) != (image.type == PixelType::F32))
        fail(file, format == ImageFormat::Png
                       ? "a .png holds no floating-point values; save this picture as .exr"
                       : "an .exr holds floating-point values only; save this picture as .png");
}

std::vector<unsigned char> encoded(const fs::path& file, const Image& image, ImageFormat format,
                                   const ImageMetadata& metadata) {
    configure_library();
    OIIO::ImageSpec spec(image.width, image.height, image.channels, type_desc_of(image.type));
    for (const auto& [key, value] : metadata) spec.attribute(key, value);
    if (format == ImageFormat::OpenExr) spec["compression"] = "zip";
    spec["oiio:UnassociatedAlpha"] = 1;
    spec["DateTime"] = "";  // without it the library writes the time of day
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const std::string id(image_format_id(format));
    const auto output = OIIO::ImageOutput::create(id);
    OIIO::Filesystem::IOProxy* proxy = &memory;
    spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    if (!output || !output->open("memory." + id, spec) ||
        !output->write_image(spec.format, image.bytes.data()) || !output->close())
        fail(file, "could not be encoded (" + one_line(output ? output->geterror() : OIIO::geterror()) +
                       "); choose another format");
    return bytes;
}

}  // namespace

void save_image(const fs::path& file, const Image& image, const ImageMetadata& metadata) {
    guarded(file, [&] {
        const ImageFormat format = image_format_of_extension(path_text(file.extension()));
        check_savable(file, image, format);
        const std::vector<unsigned char> bytes = encoded(file, image, format, metadata);
        write_file(file, std::as_bytes(std::span(bytes)));
    });
}

}  // namespace patina
