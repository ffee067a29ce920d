// JPEG through libjpeg, from memory: grey and colour. What is rarer (four inks) is left to the module.
#include "renderer/core/file_io.h"
#include "renderer/core/image_codec.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <jpeglib.h>
#include <new>
#include <stdexcept>

namespace patina {
namespace {

using Bytes = std::span<const std::byte>;

/// libjpeg's way out of an error: the sentence is kept, then back to where attempt() began.
struct Problem {
    jpeg_error_mgr manager;  ///< first: libjpeg knows no more of this
    std::jmp_buf back;
    char text[JMSG_LENGTH_MAX] = "";
};

[[noreturn]] void on_error(j_common_ptr jpeg) {
    auto* problem = reinterpret_cast<Problem*>(jpeg->err);
    jpeg->err->format_message(jpeg, problem->text);
    std::longjmp(problem->back, 1);  // NOLINT(cert-err52-cpp): libjpeg knows no other way
}

/// Damage that can be painted over is: whether the file is whole was seen before.
void on_message(j_common_ptr /*jpeg*/, int /*level*/) {}

struct Reader {
    Problem problem;
    jpeg_decompress_struct jpeg{};

    Reader() {
        jpeg.err = jpeg_std_error(&problem.manager);
        problem.manager.error_exit = on_error;
        problem.manager.emit_message = on_message;
    }
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;
    ~Reader() { jpeg_destroy_decompress(&jpeg); }
};

/// Runs calls of libjpeg. step may hold nothing that needs a destructor: an error jumps out of it.
template <class Step>
void attempt(Reader& reader, Step step) {
    // NOLINTNEXTLINE(cert-err52-cpp): libjpeg knows no other way
    if (setjmp(reader.problem.back) != 0) throw std::runtime_error(damaged(reader.problem.text));
    step();
}

void open(Reader& reader, Bytes bytes) {
    attempt(reader, [&reader, bytes] {
        jpeg_create_decompress(&reader.jpeg);
        jpeg_mem_src(&reader.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()),
                     static_cast<unsigned long>(bytes.size()));
        jpeg_save_markers(&reader.jpeg, JPEG_APP0 + 1, 0xFFFF);
        jpeg_save_markers(&reader.jpeg, JPEG_COM, 0xFFFF);
        jpeg_read_header(&reader.jpeg, TRUE);
    });
    if (const std::string problem = size_problem(reader.jpeg.image_width, reader.jpeg.image_height);
        !problem.empty())
        throw std::runtime_error(problem);
}

/// EXIF's orientation, 1…8: tag 0x112 of the first directory of its TIFF header.
int orientation_of(const Reader& reader) {
    for (const jpeg_marker_struct* marker = reader.jpeg.marker_list; marker; marker = marker->next) {
        constexpr unsigned header = 6;  // "Exif", two zeros
        if (marker->marker != JPEG_APP0 + 1 || marker->data_length < header + 8 ||
            std::memcmp(marker->data, "Exif\0", header) != 0)
            continue;
        const unsigned char* const tiff = marker->data + header;
        const unsigned size = marker->data_length - header;
        const bool little = tiff[0] == 'I';
        const auto number = [&](unsigned at, unsigned bytes) {
            unsigned value = 0;
            for (unsigned i = 0; i < bytes && at + bytes <= size; ++i)
                value |= unsigned(tiff[at + i]) << 8 * (little ? i : bytes - 1 - i);
            return value;
        };
        const unsigned directory = number(4, 4);
        if (directory > size - 2) return 1;
        for (unsigned i = 0; i < number(directory, 2); ++i) {
            const unsigned row = directory + 2 + 12 * i;
            if (row + 12 > size) return 1;
            if (number(row, 2) != 0x112) continue;
            const unsigned value = number(row + 8, 2);
            return value >= 1 && value <= 8 ? int(value) : 1;
        }
    }
    return 1;
}

DecodedHeader header(const ImageSource& source) {
    const std::vector<std::byte> bytes = read_file(source.file);
    Reader reader;
    open(reader, bytes);
    DecodedHeader result{.info = {.width = int(reader.jpeg.image_width),
                                  .height = int(reader.jpeg.image_height),
                                  .channels = reader.jpeg.num_components == 1 ? 1 : 3,
                                  .type = PixelType::U8,
                                  .format = "jpeg"}};
    for (const jpeg_marker_struct* marker = reader.jpeg.marker_list; marker; marker = marker->next)
        if (marker->marker == JPEG_COM)
            result.metadata.emplace_back(
                "ImageDescription",
                std::string(reinterpret_cast<const char*>(marker->data), marker->data_length));
    return result;
}

void decode_rows(const ImageSource& source, const StoredRows& rows) {
    Reader reader;
    open(reader, source.bytes);
    jpeg_decompress_struct& jpeg = reader.jpeg;
    const std::uint64_t pixels = std::uint64_t(jpeg.image_width) * std::uint64_t(jpeg.image_height);
    if (!can_hold(ImageFormat::Jpeg, source.bytes.size(), pixels))
        throw std::runtime_error("promises more pixels than it holds; copy or export it again");
    attempt(reader, [&jpeg] {
        jpeg.out_color_space = jpeg.num_components == 1 ? JCS_GRAYSCALE : JCS_RGB;
        jpeg_start_decompress(&jpeg);
    });
    rows.begin({.width = int(jpeg.output_width),
                .height = int(jpeg.output_height),
                .channels = jpeg.output_components,
                .type = PixelType::U8,
                .bytes = {}},
               orientation_of(reader));
    std::vector<std::byte> row(std::size_t(jpeg.output_width) * std::size_t(jpeg.output_components));
    while (jpeg.output_scanline < jpeg.output_height) {
        attempt(reader, [&jpeg, &row] {
            auto* target = reinterpret_cast<JSAMPROW>(row.data());
            jpeg_read_scanlines(&jpeg, &target, 1);
        });
        rows.row(row.data());
    }
    attempt(reader, [&jpeg] { jpeg_finish_decompress(&jpeg); });
}

constexpr ImageCodec kCodec{.header = header, .decode_rows = decode_rows};

}  // namespace

const ImageCodec& jpeg_codec() { return kCodec; }

}  // namespace patina
