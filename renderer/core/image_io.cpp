#include "renderer/core/image_io.h"

#include "renderer/core/file_io.h"
#include "renderer/core/image_codec.h"
#include "renderer/core/image_format.h"
#include "renderer/core/module_io.h"
#include "renderer/core/radiance_hdr.h"

#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>

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

/// Runs a decoder or encoder: what it throws becomes one sentence about file.
template <class Work>
auto named(const fs::path& file, Work work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        fail(file, "does not fit into memory; scale it down");
    } catch (const std::runtime_error& error) {
        fail(file, error.what());
    } catch (const std::exception& error) {
        fail(file, damaged(error.what()));
    }
}

// --- who decodes what ---

/// The codec of the module, which is loaded by the first picture that needs it.
const ImageCodec& module_codec(ImageFormat format) {
    using Entry = const ImageCodec* (*)();
    try {
        static const ImageCodec* const codec =
            reinterpret_cast<Entry>(module_symbol(kImageModule, kImageModuleEntry))();
        return *codec;
    } catch (const std::runtime_error& error) {
        throw std::runtime_error("is a picture of the kind \"" + std::string(image_format_id(format)) +
                                 "\", and " + one_line(error.what()) +
                                 "; install Patina completely, or convert the picture to PNG, EXR or HDR");
    }
}

/// Camera data in a PNG or in the header of a JPEG is read by the module, which knows its tags.
const ImageCodec& codec_for(ImageFormat format, Bytes bytes) {
    if (format == ImageFormat::OpenExr) return exr_codec();
    if (format == ImageFormat::Png && !png_has_camera_data(bytes)) return png_codec();
    if (format == ImageFormat::Jpeg && jpeg_is_plain(bytes)) return jpeg_codec();
    return module_codec(format);
}

ImageFormat known_format(const fs::path& file, Bytes bytes) {
    if (bytes.empty()) fail(file, "is empty; copy or export it again");
    const ImageFormat format = image_format_of(bytes);
    if (format == ImageFormat::Unknown)
        fail(file, "is not a PNG, JPEG, TIFF, TGA, BMP, EXR or HDR picture; convert it to one of these");
    return format;
}

void check_size(const fs::path& file, std::int64_t width, std::int64_t height) {
    if (const std::string problem = size_problem(width, height); !problem.empty()) fail(file, problem);
}

void check_promise(const fs::path& file, ImageFormat format, Bytes bytes) {
    if (const auto size = promised_size(format, bytes)) check_size(file, size->width, size->height);
}

// --- reading ---

RadianceHeader radiance_header(const fs::path& file, Bytes bytes) {
    RadianceHeader header = parse_radiance_header(bytes);
    if (!header.problem.empty()) fail(file, header.problem);
    check_size(file, header.width, header.height);
    return header;
}

LoadedImage load_radiance(const fs::path& file, Bytes bytes) {
    RadiancePicture picture = parse_radiance_pixels(bytes, radiance_header(file, bytes));
    if (!picture.problem.empty()) fail(file, picture.problem);
    return {.image = std::move(picture.image), .notes = std::move(picture.notes)};
}

/// Its shape, without texels.
Image shape_of(const Image& image) {
    return {.width = image.width,
            .height = image.height,
            .channels = image.channels,
            .type = image.type,
            .bytes = {}};
}

/// Rows put together again.
struct Collected {
    Image image;
    std::size_t at = 0;

    void begin(const Image& shape) {
        image = make_image(shape.width, shape.height, shape.channels, shape.type);
    }
    void add(const std::byte* row) {
        const std::size_t size = image.bytes.size() / static_cast<std::size_t>(image.height);
        std::memcpy(image.bytes.data() + at, row, size);
        at += size;
    }
};

void check_bytes(const fs::path& file, ImageFormat format, Bytes bytes) {
    if (const std::string problem = image_structure_problem(format, bytes); !problem.empty())
        fail(file, problem);
    check_promise(file, format, bytes);
}

DecodedImage collected(const ImageCodec& codec, const ImageSource& source) {
    if (codec.decode) return codec.decode(source);
    DecodedImage decoded;
    Collected whole;
    const auto begin = [&](const Image& shape, int orientation) {
        decoded.orientation = orientation;
        whole.begin(shape);
    };
    codec.decode_rows(source, {.begin = begin, .row = [&](const std::byte* row) { whole.add(row); }});
    decoded.loaded.image = std::move(whole.image);
    return decoded;
}

LoadedImage load_decoded(const fs::path& file, ImageFormat format, Bytes bytes) {
    check_bytes(file, format, bytes);
    return named(file, [&] {
        DecodedImage decoded =
            collected(codec_for(format, bytes), {.file = file, .format = format, .bytes = bytes});
        decoded.loaded.image = oriented(std::move(decoded.loaded.image), decoded.orientation);
        return std::move(decoded.loaded);
    });
}

LoadedImage load_bytes(const fs::path& file, ImageFormat format, Bytes bytes) {
    return format == ImageFormat::Hdr ? load_radiance(file, bytes) : load_decoded(file, format, bytes);
}

/// Given on as they come where they are stored as they are to be seen, else when all are there.
void decode_rows(const ImageCodec& codec, const ImageSource& source, const ImageRows& rows) {
    Collected turned;
    int turn = 1;
    const auto begin = [&](const Image& shape, int orientation) {
        turn = orientation;
        if (turn == 1)
            rows.begin(shape);
        else
            turned.begin(shape);
    };
    const auto add = [&](const std::byte* row) {
        if (turn == 1)
            rows.row(row);
        else
            turned.add(row);
    };
    codec.decode_rows(source, {.begin = begin, .row = add});
    if (turn != 1) give_rows(oriented(std::move(turned.image), turn), rows);
}

/// False, and nothing is given, where such a picture is decoded whole.
bool decode_by_rows(const fs::path& file, ImageFormat format, Bytes bytes, const ImageRows& rows) {
    if (format == ImageFormat::Hdr) return false;
    check_bytes(file, format, bytes);
    return named(file, [&] {
        const ImageCodec& codec = codec_for(format, bytes);
        if (!codec.decode_rows) return false;
        decode_rows(codec, {.file = file, .format = format, .bytes = bytes}, rows);
        return true;
    });
}

/// start: the first bytes of the file.
DecodedHeader decoded_header(const fs::path& file, ImageFormat format, Bytes start) {
    check_promise(file, format, start);
    return named(file, [&] {
        const bool camera_data = format == ImageFormat::Jpeg && jpeg_has_camera_data(start);
        const ImageCodec& codec = camera_data ? module_codec(format) : codec_for(format, start);
        return codec.header({.file = file, .format = format, .bytes = {}});
    });
}

void note_extension(const fs::path& file, ImageFormat format, std::vector<std::string>& notes) {
    const std::string extension = path_text(file.extension());
    if (image_format_of_extension(extension) != format)
        notes.push_back("is a picture of the kind \"" + std::string(image_format_id(format)) +
                        "\" in spite of its name");
}

}  // namespace

ImageInfo load_image_info(const fs::path& file) {
    const std::vector<std::byte> start = read_file(file, kProbeBytes);
    const ImageFormat format = known_format(file, start);
    if (format != ImageFormat::Hdr) return decoded_header(file, format, start).info;
    const RadianceHeader header = radiance_header(file, start);
    return {.width = static_cast<int>(header.width),
            .height = static_cast<int>(header.height),
            .channels = 3,
            .type = PixelType::F32,
            .format = "hdr"};
}

LoadedImage load_image(const fs::path& file) {
    const std::vector<std::byte> bytes = read_file(file);
    const ImageFormat format = known_format(file, bytes);
    LoadedImage loaded = load_bytes(file, format, bytes);
    note_extension(file, format, loaded.notes);
    return loaded;
}

void give_rows(const Image& image, const ImageRows& rows) {
    rows.begin(shape_of(image));
    const std::size_t size = image.bytes.size() / static_cast<std::size_t>(image.height);
    for (std::size_t at = 0; at < image.bytes.size(); at += size) rows.row(image.bytes.data() + at);
}

std::vector<std::string> load_image_rows(const fs::path& file, const ImageRows& rows) {
    const std::vector<std::byte> bytes = read_file(file);
    const ImageFormat format = known_format(file, bytes);
    std::vector<std::string> notes;
    if (!decode_by_rows(file, format, bytes, rows)) {
        LoadedImage loaded = load_bytes(file, format, bytes);
        give_rows(loaded.image, rows);
        notes = std::move(loaded.notes);
    }
    note_extension(file, format, notes);
    return notes;
}

ImageMetadata load_image_metadata(const fs::path& file) {
    const std::vector<std::byte> start = read_file(file, kProbeBytes);
    const ImageFormat format = known_format(file, start);
    if (format == ImageFormat::Hdr) return {};
    return decoded_header(file, format, start).metadata;
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

}  // namespace

void save_image(const fs::path& file, const Image& image, const ImageMetadata& metadata) {
    const ImageFormat format = image_format_of_extension(path_text(file.extension()));
    check_savable(file, image, format);
    const std::vector<std::byte> bytes = named(file, [&] {
        return format == ImageFormat::Png ? encode_png(image, metadata) : encode_exr(image, metadata);
    });
    write_file(file, bytes);
}

}  // namespace patina
