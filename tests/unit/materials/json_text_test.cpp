#include "materials/json_text.h"

#include "tests/unit/materials/temporary_folder.h"

#include <nlohmann/json.hpp>

namespace patina {

namespace {

using Json = nlohmann::ordered_json;

Json parsed(std::string_view text) {
    std::vector<std::string> repeated;
    return parse_json(text, "t.json", repeated);
}
std::string refusal(const std::string& text) {
    return failure_of([&] { parsed(text); });
}
std::string place(std::string_view text, const char* pointer) {
    const TextPosition at = position_of(text, Json::json_pointer(pointer));
    return std::to_string(at.line) + ":" + std::to_string(at.column);
}

}  // namespace

TEST(JsonText, names_line_and_column_of_what_is_not_json) {
    EXPECT_EQ(refusal("{\n  \"a\": 1,\n  \"b\": nul\n}").substr(0, 11), "t.json:3:11");
    EXPECT_EQ(refusal("{\n\"äöü\": [1, 2\n").substr(0, 11), "t.json:3:1:");
    EXPECT_EQ(refusal("{\"ä\": x}").substr(0, 11), "t.json:1:7:") << "columns are characters";
    EXPECT_EQ(refusal("\xEF\xBB\xBF{x}").substr(0, 11), "t.json:1:2:") << "a byte order mark is no column";
    for (const char* text :
         {"", "{", "{\"a\" 1}", "[1,]", "{} {}", "\"", "{'a': 1}", "{\"a\": NaN}", "{\"a\": +1}",
          "{\"a\": .5}", "{\"a\": 01}", "// a comment\n{}", "{\"a\": \"\n\"}", "{\"a\": \"\\ud800\"}"}) {
        const std::string sentence = refusal(text);
        EXPECT_NE(sentence.find("not valid JSON: "), std::string::npos) << text << " → " << sentence;
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
        EXPECT_EQ(sentence.find("json.exception"), std::string::npos) << sentence;
    }
}

TEST(JsonText, refuses_a_number_that_no_double_holds) {
    EXPECT_EQ(refusal("{\"a\": 1e999}"), "t.json:1:7: not valid JSON: the number is too large.");
}

TEST(JsonText, refuses_text_that_is_not_utf8_in_every_malformed_way) {
    for (const char* bytes : {"\xff", "\xc3", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                              "\xf5\x80\x80\x80", "\x80", "\xe2\x82"}) {
        const std::string sentence = refusal(std::string("{\n\"a\": \"") + bytes + "\"}");
        EXPECT_EQ(sentence, "t.json:2:7: not valid UTF-8 text; save the file as UTF-8.");
    }
    EXPECT_EQ(parsed("{\"a\": \"é€😀\"}")["a"], "é€😀");
}

TEST(JsonText, refuses_what_is_nested_too_deep_or_too_wide) {
    const std::string deepest = std::string(kMaxJsonDepth, '[') + std::string(kMaxJsonDepth, ']');
    EXPECT_NO_THROW(parsed(deepest));
    EXPECT_NE(refusal("[" + deepest + "]").find("deeper than 64 levels"), std::string::npos);
    EXPECT_NE(refusal(std::string(1 << 20, '[')).find("deeper than 64 levels"), std::string::npos);

    const std::string named = refusal(R"({"a\nb\u007f": )" + deepest + "}");
    EXPECT_NE(named.find("/a b /0/0"), std::string::npos) << named;
    EXPECT_EQ(named.find('\n'), std::string::npos) << "a key's line break would tear the sentence";

    std::string wide = "{";
    for (std::size_t i = 0; i < kMaxJsonMembers; ++i) wide += (i ? ",\"" : "\"") + std::to_string(i) + "\":0";
    EXPECT_NO_THROW(parsed(wide + "}"));
    EXPECT_NE(refusal(wide + ",\"x\":0}").find("more than 1024 keys"), std::string::npos);
}

TEST(JsonText, keeps_the_last_of_repeated_keys_and_names_them) {
    std::vector<std::string> repeated;
    const Json json = parse_json(R"({"a": 1, "b": {"c/d": 1, "c/d": 2}, "a": 3})", "t.json", repeated);
    EXPECT_EQ(json["a"], 3);
    EXPECT_EQ(json["b"]["c/d"], 2);
    EXPECT_EQ(repeated, (std::vector<std::string>{"/b/c~1d", "/a"}));
}

TEST(JsonText, finds_where_a_value_stands) {
    const std::string text =
        "\xEF\xBB\xBF{\r\n  \"a\": [1, {\"x\\\"]\": \"}\"}, -2e3],\n\t\"b\" : {\"c\": true},\n \"b\": "
        "{\"c\": 5}}";
    EXPECT_EQ(place(text, ""), "1:1");
    EXPECT_EQ(place(text, "/a"), "2:8");
    EXPECT_EQ(place(text, "/a/1/x\"]"), "2:21");
    EXPECT_EQ(place(text, "/a/2"), "2:27");
    EXPECT_EQ(place(text, "/b/c"), "4:13") << "the last of two counts";
    EXPECT_EQ(place(text, "/b/missing"), "4:7") << "the innermost thing around it";
    EXPECT_EQ(place("5", "/a"), "1:1");
    EXPECT_EQ(place("{}", "/a"), "1:1");
}

TEST(JsonText, prints_what_fits_on_one_line_and_breaks_the_rest) {
    const Json json =
        parsed(R"({"name":"Öl","v":[1.0,0.5,1e-7],"empty":{},"none":[],"o":{"a":true,"b":null},"n":-0.0})");
    EXPECT_EQ(to_text(json),
              "{\n"
              "  \"name\": \"Öl\",\n"
              "  \"v\": [1, 0.5, 1e-07],\n"
              "  \"empty\": {},\n"
              "  \"none\": [],\n"
              "  \"o\": { \"a\": true, \"b\": null },\n"
              "  \"n\": -0.0\n"
              "}\n");
    Json wide;
    wide["list"] = Json::array({std::string(60, 'x'), std::string(60, 'y')});
    EXPECT_EQ(to_text(wide), "{\n  \"list\": [\n    \"" + std::string(60, 'x') + "\",\n    \"" +
                                 std::string(60, 'y') + "\"\n  ]\n}\n");
}

TEST(JsonText, printing_and_parsing_again_gives_the_same_tree) {
    const Json json =
        parsed(R"({"a":[1.5,-3,18446744073709551615,0.1,1e300,5e-324,"\u0001\n\"\\"],"":{"~/":[[],[{}]]}})");
    EXPECT_EQ(parsed(to_text(json)), json);
}

TEST(JsonText, escapes_keys_in_pointers) { EXPECT_EQ(pointer_to("/a", "x/~y"), "/a/x~1~0y"); }

}  // namespace patina
