#pragma once
// Options that take a number.

#include "cli/parse_value.hpp"

#include <CLI/CLI.hpp>

namespace lanecast {

/// `set` gets the value. `key`, whose kind and range it obeys, outlives the command.
template <class Set>
CLI::Option* add_number_option(CLI::App& command, const std::string& name, const char* help, const KeySpec& key, const Set& set) {
    const auto parsed = [name, &key, set](const std::string& text) { set(parse_number(name, text, key)); };
    return command.add_option_function<std::string>(name, parsed, help)->type_name(key.kind == ValueKind::whole ? "N" : "X");
}

} // namespace lanecast
