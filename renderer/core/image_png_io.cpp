// PNG through libpng, from and to memory.
#include "renderer/core/file_io.h"
#include "renderer/core/image_codec.h"

#include <bit>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <memory>
#include <png.h>
#include <stdexcept>

namespace patina {
namespace {

using Bytes = std::span<const std::byte>;

/// libpng's way out of an error: the sentence is kept, then back to where attempt() began.
struct Problem {
    std::string text;
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    static_cast<Problem*>(png_get_error_ptr(png))->text = message ? message : "";
    png_longjmp(png, 1);
}

void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

/// Runs calls of libpng. step may hold nothing that needs a destructor: an error jumps out of it.
template <class Step>
void attempt(png_structp png, const Problem& problem, Step step) {
    // NOLINTNEXTLINE(cert-err52-cpp): libpng knows no other way
    if (setjmp(png_jmpbuf(png)) != 0) throw std::runtime_error(damaged(problem.text));
    step();
}

// --- reading ---

struct Reader {
    Problem problem;
    Bytes bytes;
    std::size_t at = 0;
    png_structp png = nullptr;
    png_infop info = nullptr;

    Reader() = default;
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void read_bytes(png_structp png, png_bytep data, std::size_t size) {
    auto& reader = *static_cast<Reader*>(png_get_io_ptr(png));
    if (size > reader.bytes.size() - reader.at) png_error(png, "the file ends too early");
    std::memcpy(data, reader.bytes.data() + reader.at, size);
    reader.at += size;
}

/// As the picture is read: palettes and small depths expanded, transparency as a channel, no colour
/// conversion.
void expand(const Reader& reader) {
    const int color = png_get_color_type(reader.png, reader.info);
    if (color == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(reader.png);
    if (color == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(reader.png, reader.info) < 8)
        png_set_expand_gray_1_2_4_to_8(reader.png);
    if (png_get_valid(reader.png, reader.info, PNG_INFO_tRNS) != 0) png_set_tRNS_to_alpha(reader.png);
    if (png_get_bit_depth(reader.png, reader.info) == 16 && std::endian::native == std::endian::little)
        png_set_swap(reader.png);
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
}

void open(Reader& reader, Bytes bytes) {
    reader.bytes = bytes;
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader.problem, on_error, on_warning);
    reader.info = reader.png ? png_create_info_struct(reader.png) : nullptr;
    if (!reader.info) throw std::bad_alloc();
    attempt(reader.png, reader.problem, [&reader] {
        png_set_read_fn(reader.png, &reader, read_bytes);
        png_set_user_limits(reader.png, kMaxImageSide, kMaxImageSide);
        png_set_chunk_malloc_max(reader.png, 0);  // a preset's text may be long; the file holds it anyway
        png_read_info(reader.png, reader.info);
        expand(reader);
    });
}

ImageInfo info_of(const Reader& reader) {
    return {.width = static_cast<int>(png_get_image_width(reader.png, reader.info)),
            .height = static_cast<int>(png_get_image_height(reader.png, reader.info)),
            .channels = png_get_channels(reader.png, reader.info),
            .type = png_get_bit_depth(reader.png, reader.info) == 16 ? PixelType::U16 : PixelType::U8,
            .format = "png"};
}

ImageMetadata metadata_of(const Reader& reader) {
    ImageMetadata metadata;
    png_textp rows = nullptr;
    const int count = png_get_text(reader.png, reader.info, &rows, nullptr);
    for (int i = 0; i < count; ++i) metadata.emplace_back(rows[i].key, rows[i].text ? rows[i].text : "");
    return metadata;
}

DecodedHeader header(const ImageSource& source) {
    // Text may stand anywhere before the pixels, behind a colour profile of any size.
    const std::vector<std::byte> bytes = read_file(source.file);
    Reader reader;
    open(reader, bytes);
    return {.info = info_of(reader), .metadata = metadata_of(reader)};
}

/// The rows of an interlaced picture are whole only when all are there.
void read_interlaced(Reader& reader, const Image& shape, const StoredRows& rows) {
    Image image = make_image(shape.width, shape.height, shape.channels, shape.type);
    const std::size_t row_size = image.bytes.size() / static_cast<std::size_t>(image.height);
    std::vector<png_bytep> starts(static_cast<std::size_t>(image.height));
    for (std::size_t y = 0; y < starts.size(); ++y)
        starts[y] = reinterpret_cast<png_bytep>(image.bytes.data() + y * row_size);
    attempt(reader.png, reader.problem, [&reader, &starts] { png_read_image(reader.png, starts.data()); });
    for (const png_bytep start : starts) rows.row(reinterpret_cast<const std::byte*>(start));
}

void read_rows(Reader& reader, const Image& shape, const StoredRows& rows) {
    std::vector<png_byte> row(png_get_rowbytes(reader.png, reader.info));
    for (int y = 0; y < shape.height; ++y) {
        attempt(reader.png, reader.problem,
                [&reader, &row] { png_read_row(reader.png, row.data(), nullptr); });
        rows.row(reinterpret_cast<const std::byte*>(row.data()));
    }
}

void decode_rows(const ImageSource& source, const StoredRows& rows) {
    Reader reader;
    open(reader, source.bytes);
    const ImageInfo info = info_of(reader);
    if (const std::string problem = size_problem(info.width, info.height); !problem.empty())
        throw std::runtime_error(problem);
    if (!can_hold(ImageFormat::Png, source.bytes.size(),
                  static_cast<std::uint64_t>(info.width) * info.height))
        throw std::runtime_error("promises more pixels than it holds; copy or export it again");
    const Image shape{.width = info.width,
                      .height = info.height,
                      .channels = info.channels,
                      .type = info.type,
                      .bytes = {}};
    const std::size_t row_size =
        static_cast<std::size_t>(info.width) * info.channels * bytes_per_channel(info.type);
    if (png_get_rowbytes(reader.png, reader.info) != row_size)
        throw std::runtime_error(damaged("rows of a strange size"));
    rows.begin(shape, 1);
    const bool interlaced = png_get_interlace_type(reader.png, reader.info) != PNG_INTERLACE_NONE;
    interlaced ? read_interlaced(reader, shape, rows) : read_rows(reader, shape, rows);
    attempt(reader.png, reader.problem, [&reader] { png_read_end(reader.png, nullptr); });
}

// --- writing ---

struct Writer {
    Problem problem;
    std::vector<std::byte> bytes;
    png_structp png = nullptr;
    png_infop info = nullptr;

    Writer() = default;
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png, &info); }
};

void write_bytes(png_structp png, png_bytep data, std::size_t size) {
    auto& writer = *static_cast<Writer*>(png_get_io_ptr(png));
    const auto* first = reinterpret_cast<const std::byte*>(data);
    bool stored = false;
    try {
        writer.bytes.insert(writer.bytes.end(), first, first + size);
        stored = true;
    } catch (const std::exception&) {
        stored = false;  // no exception may cross libpng's frames
    }
    if (!stored) png_error(png, "there is not enough memory");
}

void flush_bytes(png_structp /*png*/) {}

/// PNG's plain text chunks are Latin-1; anything beyond ASCII goes into an international one, which is UTF-8.
std::vector<png_text> text_rows(const ImageMetadata& metadata) {
    std::vector<png_text> rows;
    for (const auto& [key, value] : metadata) {
        bool ascii = true;
        for (const char c : value) ascii = ascii && static_cast<unsigned char>(c) < 0x80;
        png_text row{};
        row.compression = ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
        row.key = const_cast<char*>(key.c_str());     // NOLINT: only read
        row.text = const_cast<char*>(value.c_str());  // NOLINT: only read
        row.text_length = ascii ? value.size() : 0;
        row.itxt_length = ascii ? 0 : value.size();
        rows.push_back(row);
    }
    return rows;
}

int color_type(int channels) {
    constexpr int types[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                             PNG_COLOR_TYPE_RGB_ALPHA};
    return types[channels - 1];
}

}  // namespace

const ImageCodec& png_codec() {
    static constexpr ImageCodec codec{.header = header, .decode_rows = decode_rows};
    return codec;
}

/// Of zlib's 9 the last that is quick: a third of the time of its usual 6, for files a tenth larger.
static constexpr int kCompressionLevel = 4;

std::vector<std::byte> encode_png(const Image& image, const ImageMetadata& metadata) {
    Writer writer;
    writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer.problem, on_error, on_warning);
    writer.info = writer.png ? png_create_info_struct(writer.png) : nullptr;
    if (!writer.info) throw std::bad_alloc();
    const std::vector<png_text> text = text_rows(metadata);
    const std::size_t row_size = image.bytes.size() / static_cast<std::size_t>(image.height);
    attempt(writer.png, writer.problem, [&] {
        png_set_write_fn(writer.png, &writer, write_bytes, flush_bytes);
        png_set_user_limits(writer.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_set_compression_level(writer.png, kCompressionLevel);
        png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(image.width),
                     static_cast<png_uint_32>(image.height), image.type == PixelType::U16 ? 16 : 8,
                     color_type(image.channels), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                     PNG_FILTER_TYPE_DEFAULT);
        png_set_text(writer.png, writer.info, text.data(), static_cast<int>(text.size()));
        png_write_info(writer.png, writer.info);
        if (image.type == PixelType::U16 && std::endian::native == std::endian::little)
            png_set_swap(writer.png);
        for (int y = 0; y < image.height; ++y)
            png_write_row(writer.png, reinterpret_cast<png_const_bytep>(image.bytes.data()) + y * row_size);
        png_write_end(writer.png, nullptr);
    });
    return std::move(writer.bytes);
}

}  // namespace patina
