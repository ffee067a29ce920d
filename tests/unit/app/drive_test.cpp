#include "app/drive.h"

#include "app/window.h"

#include <gtest/gtest.h>

namespace {

using namespace patina;

std::string error_of(const std::string& script) {
    try {
        parse_drive(script, "demo");
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(DriveScript, splits_words_keeps_quoted_blanks_and_skips_comments) {
    const auto commands =
        parse_drive("\n# a demo\nclick \"library.presets.Rusted iron\"   # that one\n\ttype \"\"\n", "demo");
    ASSERT_EQ(commands.size(), 2u);
    EXPECT_EQ(commands[0].line, 3);
    EXPECT_EQ(commands[0].words, (std::vector<std::string>{"click", "library.presets.Rusted iron"}));
    EXPECT_EQ(commands[1].words, (std::vector<std::string>{"type", ""}));
}

TEST(DriveScript, names_the_line_of_what_it_does_not_understand) {
    EXPECT_EQ(error_of("wait idle\njump\n"), "demo:2: there is no command 'jump'.");
    EXPECT_EQ(error_of("drag a\n"), "demo:1: 'drag' has the wrong number of words.");
    EXPECT_EQ(error_of("type \"open\nquit"), "demo:1: a quotation mark is left open.");
    EXPECT_EQ(error_of("click a\r\nquit\r\n"), "");
}

TEST(DriveScript, knows_keys_by_name) {
    EXPECT_EQ(key_code("z"), 'Z');
    EXPECT_EQ(key_code("5"), '5');
    EXPECT_EQ(key_code("escape"), 256);
    EXPECT_EQ(key_code("f1"), 290);
    EXPECT_EQ(key_code("f25"), 314);
    EXPECT_EQ(key_code("hyper"), 0);
}

}  // namespace
