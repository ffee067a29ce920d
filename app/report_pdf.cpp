#include "app/report_pdf.h"

#include "app/sheet.h"
#include "app/utf8.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <hpdf.h>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace patina {

namespace {

// Points (1/72 inch).
constexpr float kPageWidth = 595.28f, kPageHeight = 841.89f, kMargin = 48.0f;
constexpr float kTextWidth = kPageWidth - 2.0f * kMargin;
constexpr float kFoot = 30.0f;
constexpr float kLineHeight = 1.38f;  ///< of the size
constexpr float kGap = 6.0f;

enum class Face { Regular, Bold, Mono };
struct Style {
    Face face = Face::Regular;
    float size = 9.5f;
    float grey = 0.1f;  ///< 0 black, 1 white
};
constexpr Style kBody{}, kSmall{.size = 8.0f, .grey = 0.38f}, kHead{.face = Face::Bold, .size = 13.0f},
    kRowHead{.face = Face::Bold, .size = 10.0f}, kTableHead{.face = Face::Bold, .size = 8.5f, .grey = 0.38f},
    kTable{.size = 8.5f}, kTitle{.face = Face::Bold, .size = 20.0f}, kMono{.face = Face::Mono, .size = 7.5f};

struct CodePair {
    int code;
    unsigned char byte;
};
// What Windows-1252 has between 0x80 and 0x9F, as far as texts use it.
constexpr std::array kLatinExtra{CodePair{0x20AC, 0x80}, CodePair{0x2026, 0x85}, CodePair{0x2018, 0x91},
                                 CodePair{0x2019, 0x92}, CodePair{0x201C, 0x93}, CodePair{0x201D, 0x94},
                                 CodePair{0x2022, 0x95}, CodePair{0x2013, 0x96}, CodePair{0x2014, 0x97}};
// Adobe's Symbol font.
constexpr std::array kSymbols{CodePair{0x0394, 0x44}, CodePair{0x03C0, 0x70}, CodePair{0x2192, 0xAE},
                              CodePair{0x2212, 0x2D}, CodePair{0x2248, 0xBB}, CodePair{0x2264, 0xA3},
                              CodePair{0x2265, 0xB3}, CodePair{0x221A, 0xD6}};

template <class Table>
std::optional<unsigned char> byte_in(const Table& table, int code) {
    for (const CodePair& pair : table)
        if (pair.code == code) return pair.byte;
    return std::nullopt;
}
std::optional<unsigned char> latin_byte(int code) {
    const bool direct = (code >= 0x20 && code < 0x7F) || (code >= 0xA0 && code <= 0xFF);
    return direct ? std::optional(static_cast<unsigned char>(code)) : byte_in(kLatinExtra, code);
}

/// A piece of text that one font shows; what none has is drawn from the interface's font as a picture.
struct Run {
    enum class Kind { Latin, Symbol, Drawn } kind = Kind::Latin;
    std::string text;  ///< the font's own bytes; UTF-8 where drawn
};
std::vector<Run> runs_of(std::string_view text) {
    std::vector<Run> runs;
    while (!text.empty()) {
        const std::string_view before = text;
        const int code = next_code_point(text);
        Run next;
        if (const auto latin = latin_byte(code))
            next = {Run::Kind::Latin, {static_cast<char>(*latin)}};
        else if (const auto symbol = byte_in(kSymbols, code))
            next = {Run::Kind::Symbol, {static_cast<char>(*symbol)}};
        else if (code < 0x20)
            next = {Run::Kind::Latin, " "};
        else
            next = {Run::Kind::Drawn, std::string(before.substr(0, before.size() - text.size()))};
        if (!runs.empty() && runs.back().kind == next.kind)
            runs.back().text += next.text;
        else
            runs.push_back(std::move(next));
    }
    return runs;
}

class Writer {
public:
    explicit Writer(const Report& report) : report_(report), pdf_(HPDF_New(nullptr, nullptr)) {
        if (!pdf_) throw std::runtime_error("the report: there is not enough memory for a PDF document");
        HPDF_SetCompressionMode(pdf_, HPDF_COMP_ALL);
        const char* encoding = "WinAnsiEncoding";
        fonts_ = {HPDF_GetFont(pdf_, "Helvetica", encoding), HPDF_GetFont(pdf_, "Helvetica-Bold", encoding),
                  HPDF_GetFont(pdf_, "Courier", encoding)};
        symbol_ = HPDF_GetFont(pdf_, "Symbol", nullptr);
        HPDF_SetInfoAttr(pdf_, HPDF_INFO_TITLE, latin(report.title).c_str());
        if (!report.author.empty()) HPDF_SetInfoAttr(pdf_, HPDF_INFO_AUTHOR, latin(report.author).c_str());
        HPDF_SetInfoAttr(pdf_, HPDF_INFO_CREATOR, latin(report.made_with).c_str());
        new_page();
    }
    ~Writer() { HPDF_Free(pdf_); }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    std::vector<unsigned char> write() {
        paragraph(report_.title, kTitle);
        if (!report_.author.empty()) paragraph(report_.author, {.size = 10.5f, .grey = 0.38f});
        for (const ReportSection& section : report_.sections) write_section(section);
        number_pages();
        return bytes();
    }

private:
    /// The nearest text in Windows-1252, for the document's properties and bookmarks.
    static std::string latin(const std::string& text) {
        std::string result;
        for (const Run& run : runs_of(text)) result += run.kind == Run::Kind::Latin ? run.text : "?";
        return result;
    }

    // --- text ---

    HPDF_Font font(const Run& run, Face face) const {
        return run.kind == Run::Kind::Symbol ? symbol_ : fonts_[std::size_t(face)];
    }
    float width_of(const Run& run, const Style& style) const {
        if (run.kind == Run::Kind::Drawn) {
            const Image drawn = text_coverage(run.text, kDrawnPx);
            return drawn.empty() ? 0.0f : style.size * float(drawn.width) / kDrawnPx;
        }
        const auto* bytes = reinterpret_cast<const HPDF_BYTE*>(run.text.data());
        return float(HPDF_Font_TextWidth(font(run, style.face), bytes, HPDF_UINT(run.text.size())).width) *
               style.size / 1000.0f;
    }
    float width_of(std::string_view text, const Style& style) const {
        float width = 0.0f;
        for (const Run& run : runs_of(text)) width += width_of(run, style);
        return width;
    }

    /// Lines no wider than width, broken at blanks, or inside a word that is wider than a line.
    std::vector<std::string> broken(const std::string& text, const Style& style, float width) const {
        std::vector<std::string> lines(1);
        std::size_t start = 0;
        while (start <= text.size()) {
            const std::size_t end = std::min(text.find_first_of(" \n", start), text.size());
            std::string word = text.substr(start, end - start);
            const std::string joined = lines.back().empty() ? word : lines.back() + " " + word;
            if (width_of(joined, style) <= width) {
                lines.back() = joined;
            } else {
                if (!lines.back().empty()) lines.emplace_back();
                while (width_of(word, style) > width) break_word(word, style, width, lines);
                lines.back() = word;
            }
            if (end < text.size() && text[end] == '\n') lines.emplace_back();
            start = end + 1;
        }
        return lines;
    }
    /// Moves what fits of the word's beginning into the last line and starts another.
    void break_word(std::string& word, const Style& style, float width,
                    std::vector<std::string>& lines) const {
        std::string_view rest = word;
        std::size_t taken = 0;
        while (!rest.empty()) {
            next_code_point(rest);
            const std::size_t end = word.size() - rest.size();
            if (taken > 0 && width_of(std::string_view(word).substr(0, end), style) > width) break;
            taken = end;
        }
        lines.back() = word.substr(0, taken);
        lines.emplace_back();
        word.erase(0, taken);
    }

    void put_line(std::string_view text, const Style& style, float x, float baseline) {
        for (const Run& run : runs_of(text)) {
            const float width = width_of(run, style);
            if (run.kind == Run::Kind::Drawn) {
                put_drawn(run, style, x, baseline);
            } else {
                HPDF_Page_SetGrayFill(page_, style.grey);
                HPDF_Page_BeginText(page_);
                HPDF_Page_SetFontAndSize(page_, font(run, style.face), style.size);
                HPDF_Page_TextOut(page_, x, baseline, run.text.c_str());
                HPDF_Page_EndText(page_);
            }
            x += width;
        }
    }
    void put_drawn(const Run& run, const Style& style, float x, float baseline) {
        const Image coverage = text_coverage(run.text, kDrawnPx);
        if (coverage.empty()) return;
        Image ink = make_image(coverage.width, coverage.height, 3, PixelType::U8);
        for (int y = 0; y < ink.height; ++y)
            for (int column = 0; column < ink.width; ++column)
                for (int c = 0; c < 3; ++c)
                    set_texel(ink, column, y, c, 1.0f - (1.0f - style.grey) * texel(coverage, column, y, 0));
        const float height = style.size * float(ink.height) / kDrawnPx;
        put_image(ink, x, baseline - 0.22f * height, style.size * float(ink.width) / kDrawnPx, height);
    }

    void paragraph(const std::string& text, const Style& style, float indent = 0.0f) {
        const std::vector<std::string> lines = broken(text, style, kTextWidth - indent);
        if (lines.size() <= 4) need(float(lines.size()) * style.size * kLineHeight);  // stays together
        for (const std::string& line : lines) {
            need(style.size * kLineHeight);
            top_ -= style.size * kLineHeight;
            put_line(line, style, kMargin + indent, top_ + 0.28f * style.size);
        }
        top_ -= 0.35f * style.size;
    }

    // --- pictures ---

    void put_image(const Image& image, float x, float y, float width, float height) {
        assert(image.type == PixelType::U8 && image.channels == 3);
        const auto* pixels = reinterpret_cast<const HPDF_BYTE*>(image.bytes.data());
        const HPDF_Image loaded = HPDF_LoadRawImageFromMem(pdf_, pixels, HPDF_UINT(image.width),
                                                           HPDF_UINT(image.height), HPDF_CS_DEVICE_RGB, 8);
        if (loaded) HPDF_Page_DrawImage(page_, loaded, x, y, width, height);
    }

    void write_pictures(const ReportSection& section) {
        std::size_t columns = std::size_t(std::max(section.picture_columns, 0));
        if (columns == 0)
            for (const ReportPictureRow& row : section.pictures)
                columns = std::max(columns, row.pictures.size());
        if (columns == 0) return;
        const float width = (kTextWidth - kGap * float(columns - 1)) / float(columns);
        for (const ReportPictureRow& row : section.pictures)
            for (std::size_t first = 0; first < row.pictures.size(); first += columns)
                write_row(row, first, std::min(first + columns, row.pictures.size()), width);
    }
    /// Of the first row of pictures with its heading, captions left out.
    static float first_row_height(const ReportSection& section) {
        if (section.pictures.empty()) return 0.0f;
        const ReportPictureRow& row = section.pictures.front();
        std::size_t columns = std::size_t(std::max(section.picture_columns, 0));
        for (const ReportPictureRow& each : section.pictures)
            if (section.picture_columns == 0) columns = std::max(columns, each.pictures.size());
        const float width =
            (kTextWidth - kGap * float(columns - 1)) / float(std::max<std::size_t>(columns, 1));
        float height = 0.0f;
        for (const ReportPicture& picture : row.pictures)
            if (!picture.image.empty()) height = std::max(height, shown_height(picture.image, width));
        return height + (row.heading.empty() ? 0.0f : kRowHead.size * 2.0f) +
               3.0f * kSmall.size * kLineHeight;
    }
    void write_row(const ReportPictureRow& row, std::size_t first, std::size_t end, float width) {
        float height = 0.0f;
        std::size_t caption_lines = 0;
        std::vector<std::vector<std::string>> captions;
        for (std::size_t i = first; i < end; ++i) {
            const ReportPicture& picture = row.pictures[i];
            if (!picture.image.empty()) height = std::max(height, shown_height(picture.image, width));
            captions.push_back(picture.caption.empty() ? std::vector<std::string>{}
                                                       : broken(picture.caption, kSmall, width));
            caption_lines = std::max(caption_lines, captions.back().size());
        }
        const bool with_heading = first == 0 && !row.heading.empty();
        const float caption = float(caption_lines) * kSmall.size * kLineHeight;
        need(height + caption + kGap + (with_heading ? kRowHead.size * 2.0f : 0.0f));
        if (with_heading) paragraph(row.heading, kRowHead);
        for (std::size_t i = first; i < end; ++i) {
            const float x = kMargin + float(i - first) * (width + kGap);
            const Image& image = row.pictures[i].image;
            if (!image.empty()) {
                const float shown = shown_height(image, width);
                const float shown_width = shown * float(image.width) / float(image.height);
                put_image(image, x, top_ - shown, shown_width, shown);
            }
            float baseline = top_ - height - kSmall.size;
            for (const std::string& line : captions[i - first]) {
                put_line(line, kSmall, x, baseline);
                baseline -= kSmall.size * kLineHeight;
            }
        }
        top_ -= height + caption + kGap;
    }
    /// Its width in the grid sets the height, but no picture is higher than most of a page.
    static float shown_height(const Image& image, float width) {
        return std::min(width * float(image.height) / float(image.width), 0.7f * kPageHeight);
    }

    // --- tables ---

    std::vector<float> column_widths(const ReportTable& table) const {
        std::vector<float> widths;
        const auto measure = [&](const std::vector<std::string>& cells, const Style& style) {
            widths.resize(std::max(widths.size(), cells.size()), 0.0f);
            for (std::size_t i = 0; i < cells.size(); ++i)
                widths[i] = std::max(widths[i], width_of(cells[i], style) + 10.0f);
        };
        measure(table.header, kTableHead);
        for (const auto& cells : table.rows) measure(cells, kTable);
        // Where there is too little room, the widest columns give way, all to one width.
        std::vector<float> narrow_first = widths;
        std::ranges::sort(narrow_first);
        float room = kTextWidth;
        for (std::size_t i = 0; i < narrow_first.size(); ++i) {
            const float fair = room / float(narrow_first.size() - i);
            if (narrow_first[i] > fair) {
                for (float& width : widths) width = std::min(width, fair);
                break;
            }
            room -= narrow_first[i];
        }
        return widths;
    }
    float table_row_height(const std::vector<std::string>& cells, const std::vector<float>& widths,
                           const Style& style) const {
        std::size_t most = 1;
        for (std::size_t i = 0; i < cells.size(); ++i)
            most = std::max(most, broken(cells[i], style, widths[i] - 8.0f).size());
        return float(most) * style.size * kLineHeight + 4.0f;
    }
    /// A header stands at the head of every page that the table reaches.
    void write_table(const ReportTable& table) {
        const std::vector<float> widths = column_widths(table);
        const float head = table.header.empty() ? 0.0f : table_row_height(table.header, widths, kTableHead);
        float whole = head;
        for (const auto& cells : table.rows) whole += table_row_height(cells, widths, kTable);
        if (whole < 0.5f * kPageHeight) need(whole);
        for (std::size_t row = 0; row < table.rows.size(); ++row) {
            const std::size_t page = pages_.size();
            need(table_row_height(table.rows[row], widths, kTable) + (row == 0 ? head : 0.0f));
            if (head > 0.0f && (row == 0 || pages_.size() != page))
                write_table_row(table.header, widths, kTableHead);
            write_table_row(table.rows[row], widths, kTable);
        }
    }
    void write_table_row(const std::vector<std::string>& cells, const std::vector<float>& widths,
                         const Style& style) {
        std::vector<std::vector<std::string>> lines;
        for (std::size_t i = 0; i < cells.size(); ++i)
            lines.push_back(broken(cells[i], style, widths[i] - 8.0f));
        const float height = table_row_height(cells, widths, style);
        float x = kMargin;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            float baseline = top_ - style.size - 1.0f;
            for (const std::string& line : lines[i]) {
                put_line(line, style, x, baseline);
                baseline -= style.size * kLineHeight;
            }
            x += widths[i];
        }
        top_ -= height;
        rule(0.9f);
    }
    void rule(float grey) {
        HPDF_Page_SetGrayStroke(page_, grey);
        HPDF_Page_SetLineWidth(page_, 0.5f);
        HPDF_Page_MoveTo(page_, kMargin, top_);
        HPDF_Page_LineTo(page_, kPageWidth - kMargin, top_);
        HPDF_Page_Stroke(page_);
    }

    void write_section(const ReportSection& section) {
        // No heading alone at a page's end: what follows it fits below.
        need(std::max(110.0f, 48.0f + first_row_height(section)));
        top_ -= 12.0f;
        const HPDF_Outline mark = HPDF_CreateOutline(pdf_, nullptr, latin(section.heading).c_str(), nullptr);
        HPDF_Outline_SetDestination(mark, HPDF_Page_CreateDestination(page_));
        paragraph(section.heading, kHead);
        rule(0.82f);
        top_ -= 6.0f;
        for (const std::string& text : section.paragraphs) paragraph(text, kBody);
        write_pictures(section);
        if (section.table) {
            write_table(*section.table);
            top_ -= 6.0f;
        }
        for (const std::string& note : section.notes) paragraph(note, kSmall);
        for (const std::string& command : section.commands) paragraph(command, kMono, 6.0f);
    }

    // --- pages ---

    void new_page() {
        page_ = HPDF_AddPage(pdf_);
        if (!page_) throw std::runtime_error("the report: a page could not be added to the PDF document");
        HPDF_Page_SetSize(page_, HPDF_PAGE_SIZE_A4, HPDF_PAGE_PORTRAIT);
        pages_.push_back(page_);
        top_ = kPageHeight - kMargin;
    }
    void need(float height) {
        if (top_ - height < kMargin + kFoot && top_ < kPageHeight - kMargin) new_page();
    }
    void number_pages() {
        for (std::size_t i = 0; i < pages_.size(); ++i) {
            page_ = pages_[i];
            const std::string number = std::to_string(i + 1) + " / " + std::to_string(pages_.size());
            put_line(report_.made_with, kSmall, kMargin, kMargin);
            put_line(number, kSmall, kPageWidth - kMargin - width_of(number, kSmall), kMargin);
        }
    }
    std::vector<unsigned char> bytes() {
        HPDF_SaveToStream(pdf_);
        if (HPDF_GetError(pdf_) != HPDF_OK)
            throw std::runtime_error("the report: libharu could not make the PDF (error " +
                                     std::to_string(HPDF_GetError(pdf_)) + "); write it as .html instead");
        std::vector<unsigned char> result(HPDF_GetStreamSize(pdf_));
        HPDF_UINT32 size = HPDF_UINT32(result.size());
        HPDF_ResetStream(pdf_);
        HPDF_ReadFromStream(pdf_, result.data(), &size);
        result.resize(size);
        return result;
    }

    static constexpr float kDrawnPx = 40.0f;  ///< height of text drawn as a picture

    const Report& report_;
    HPDF_Doc pdf_;
    std::array<HPDF_Font, 3> fonts_{};
    HPDF_Font symbol_ = nullptr;
    HPDF_Page page_ = nullptr;
    std::vector<HPDF_Page> pages_;
    float top_ = 0.0f;  ///< where the next thing begins, from the page's lower edge
};

}  // namespace

std::vector<unsigned char> to_pdf(const Report& report) { return Writer(report).write(); }

}  // namespace patina
