// A strict validator for the part of JSON Schema (draft 2020-12) that the preset schema uses. A keyword it
// does not know is an error, so that the schema cannot promise what nobody checks.
#pragma once

#include <nlohmann/json.hpp>

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace patina {

class SchemaValidator {
public:
    explicit SchemaValidator(nlohmann::json schema) : root_(std::move(schema)) { require_known(root_); }

    /// What is wrong, with its place; empty if nothing is.
    std::vector<std::string> problems_of(const nlohmann::json& value) const {
        std::vector<std::string> problems;
        check(root_, value, "", problems);
        return problems;
    }
    /// The schema that a reference, if it is one, leads to.
    const nlohmann::json& resolved(const nlohmann::json& schema) const {
        if (!schema.contains("$ref")) return schema;
        const std::string target = schema["$ref"];
        if (!target.starts_with("#"))
            throw std::runtime_error("only references inside the schema: " + target);
        return root_.at(nlohmann::json::json_pointer(target.substr(1)));
    }

private:
    using Json = nlohmann::json;

    void require_known(const Json& schema) const {
        static const std::set<std::string> kKnown{"$schema",  "$defs",      "$ref",   "title", "description",
                                                  "type",     "properties", "enum",   "items", "minItems",
                                                  "maxItems", "minimum",    "maximum"};
        for (const auto& [keyword, value] : schema.items()) {
            if (!kKnown.count(keyword)) throw std::runtime_error("unknown keyword " + keyword);
            if (keyword == "properties" || keyword == "$defs")
                for (const auto& member : value) require_known(member);
            if (keyword == "items") require_known(value);
            if (keyword == "$ref") resolved(schema);
        }
    }
    static bool has_type(const Json& value, const std::string& type) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "number") return value.is_number();
        if (type == "boolean") return value.is_boolean();
        throw std::runtime_error("unknown type " + type);
    }
    void check(const Json& schema, const Json& value, const std::string& place,
               std::vector<std::string>& problems) const {
        const auto wrong = [&](const std::string& what) { problems.push_back(place + " " + what); };
        if (schema.contains("$ref")) check(resolved(schema), value, place, problems);
        if (schema.contains("type") && !has_type(value, schema["type"])) {
            wrong("is not of type " + schema["type"].get<std::string>());
            return;
        }
        if (schema.contains("enum") &&
            std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
            wrong("is none of " + schema["enum"].dump());
        if (value.is_number() && schema.contains("minimum") && value < schema["minimum"])
            wrong("is too small");
        if (value.is_number() && schema.contains("maximum") && value > schema["maximum"])
            wrong("is too large");
        if (value.is_array() && schema.contains("minItems") && value.size() < schema["minItems"])
            wrong("is too short");
        if (value.is_array() && schema.contains("maxItems") && value.size() > schema["maxItems"])
            wrong("is too long");
        if (value.is_array() && schema.contains("items"))
            for (std::size_t i = 0; i < value.size(); ++i)
                check(schema["items"], value[i], place + "/" + std::to_string(i), problems);
        if (value.is_object() && schema.contains("properties"))
            for (const auto& [key, member] : value.items())
                if (schema["properties"].contains(key))
                    check(schema["properties"][key], member, place + "/" + key, problems);
    }

    Json root_;
};

}  // namespace patina
