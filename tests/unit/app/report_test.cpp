// The report as a web page and as PDF: well-formed, complete, self-contained, and safe against what texts
// contain.
#include "app/report_pdf.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_image.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace patina {
namespace {

Image stripes(int width, int height) {
    Image image = make_image(width, height, 3, PixelType::U8);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) set_texel(image, x, y, x % 3, 1.0f);
    return image;
}

Report sample(int rows = 2) {
    Report report{.title = "Rust & <gold>", .author = "Zoë Müller", .made_with = "Made with a test"};
    ReportSection sheet{.heading = "Side by side",
                        .paragraphs = {"A paragraph that is long enough to be broken over "
                                       "more than one line of a page, since it goes on and "
                                       "on, and on, and on, until it ends here."}};
    for (int i = 0; i < rows; ++i)
        sheet.pictures.push_back(
            {"Row " + std::to_string(i), {{"Studio", stripes(30, 20)}, {"ΔE 3 → 2, 木", stripes(30, 20)}}});
    sheet.table =
        ReportTable{.header = {"Parameter", "Value"}, .rows = {{"Roughness", "0.3"}, {"Map", "a<b>.png"}}};
    sheet.notes = {"A note."};
    sheet.commands = {"patina render gold -o a.png"};
    report.sections = {sheet};
    return report;
}

std::size_t count(std::string_view text, std::string_view what) {
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what, at + 1)) ++n;
    return n;
}

/// Every stream of the document, inflated where it is deflated.
std::string inflated(const std::vector<unsigned char>& pdf) {
    const std::string_view text(reinterpret_cast<const char*>(pdf.data()), pdf.size());
    std::string all;
    for (std::size_t at = text.find("stream\r\n"); at != std::string_view::npos;
         at = text.find("stream\r\n", at + 1)) {
        if (at >= 3 && text.substr(at - 3, 3) == "end") continue;
        const std::size_t begin = at + 8, end = text.find("endstream", begin);
        if (end == std::string_view::npos) break;
        int size = 0;
        char* plain = stbi_zlib_decode_malloc(text.data() + begin, int(end - begin), &size);
        if (plain) all.append(plain, std::size_t(size));
        stbi_image_free(plain);
    }
    return all;
}

TEST(ReportHtml, escapes_texts_and_embeds_every_picture) {
    const std::string html = to_html(sample());
    EXPECT_NE(html.find("<title>Rust &amp; &lt;gold&gt;</title>"), std::string::npos);
    EXPECT_EQ(html.find("<gold>"), std::string::npos);
    EXPECT_NE(html.find("a&lt;b&gt;.png"), std::string::npos);
    EXPECT_EQ(count(html, "<img "), 4u);
    EXPECT_EQ(count(html, "src=\"data:image/png;base64,"), 4u);
    EXPECT_EQ(html.find("http"), std::string::npos) << "it must need no network";
    for (const char* tag :
         {"figure", "table", "section", "tr", "p", "h1", "h2", "h3", "div", "pre", "body", "html"})
        EXPECT_EQ(count(html, "<" + std::string(tag) + ">") + count(html, "<" + std::string(tag) + " "),
                  count(html, "</" + std::string(tag) + ">"))
            << tag;
}

TEST(ReportHtml, an_embedded_picture_is_the_picture) {
    const Image image = stripes(37, 11);
    const std::vector<unsigned char> png = png_bytes(image);
    int width = 0, height = 0, channels = 0;
    unsigned char* pixels = stbi_load_from_memory(png.data(), int(png.size()), &width, &height, &channels, 0);
    ASSERT_TRUE(pixels);
    EXPECT_EQ(width, 37);
    EXPECT_EQ(height, 11);
    EXPECT_EQ(channels, 3);
    EXPECT_EQ(std::memcmp(pixels, image.bytes.data(), image.bytes.size()), 0);
    stbi_image_free(pixels);
}

TEST(ReportHtml, base64_is_rfc_4648) {
    const auto encoded = [](std::string_view text) {
        return base64(std::vector<unsigned char>(text.begin(), text.end()));
    };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(ReportPdf, is_a_document_with_pages_pictures_and_text) {
    const std::vector<unsigned char> pdf = to_pdf(sample());
    const std::string_view text(reinterpret_cast<const char*>(pdf.data()), pdf.size());
    EXPECT_TRUE(text.starts_with("%PDF-1."));
    EXPECT_NE(text.find("%%EOF"), std::string_view::npos);
    EXPECT_EQ(count(text, "/Type /Page\n") + count(text, "/Type /Page\r"), 1u);
    EXPECT_GE(count(text, "/Subtype /Image"), 4u);
    EXPECT_NE(text.find("/Title (Rust & \\074gold\\076)"), std::string_view::npos);
    const std::string content = inflated(pdf);
    EXPECT_NE(content.find("(Roughness) Tj"), std::string::npos);
    EXPECT_NE(content.find("(patina render gold -o a.png) Tj"), std::string::npos);
    EXPECT_NE(content.find("(Rust & \\074gold\\076) Tj"), std::string::npos);
    EXPECT_NE(content.find("(1 \\057 1) Tj"), std::string::npos);
}

TEST(ReportPdf, long_reports_go_over_several_pages) {
    const std::vector<unsigned char> pdf = to_pdf(sample(12));
    const std::string content = inflated(pdf);
    EXPECT_NE(content.find("(2 \\057 "), std::string::npos);
    EXPECT_NE(content.find("(Row 11) Tj"), std::string::npos);
}

TEST(ReportPdf, long_words_and_broken_utf8_do_no_harm) {
    Report report = sample();
    report.sections[0].paragraphs = {std::string(3000, 'x'), "broken \xF0\x9F end \xFF", "", "\n\n"};
    report.sections[0].table->rows.push_back({std::string(500, 'y'), std::string(500, 'z')});
    EXPECT_GT(to_pdf(report).size(), 1000u);
}

TEST(ReportPdf, the_same_report_gives_the_same_bytes) { EXPECT_EQ(to_pdf(sample()), to_pdf(sample())); }

}  // namespace
}  // namespace patina
