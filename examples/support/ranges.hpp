#pragma once
#include <CLI/CLI.hpp>

#include <cctype>
#include <cmath>
#include <string>

// Checks of options that are numbers. CLI11's own take NaN for one in any range, and "010" for eight.

/// A finite number from `least` to `most`.
inline CLI::Validator number_from(double least, double most) {
    return {[least, most](std::string& given) {
                double value = 0;
                if (!CLI::detail::lexical_cast(given, value) || !std::isfinite(value))
                    return "'" + given + "' is not a number";
                if (value < least || value > most)
                    return given + " is not between " + CLI::detail::to_string(least) + " and " +
                           CLI::detail::to_string(most);
                return std::string();
            },
            "", "number_from"};
}
/// A whole number from `least` to `most`, in decimal digits that do not begin with 0.
inline CLI::Validator whole_from(long least, long most) {
    return {[least, most](std::string& given) {
                const std::size_t sign = !given.empty() && (given[0] == '-' || given[0] == '+') ? 1 : 0;
                bool decimal = given.size() > sign && (given[sign] != '0' || given.size() == sign + 1);
                for (std::size_t k = sign; k < given.size(); ++k)
                    decimal = decimal && std::isdigit(static_cast<unsigned char>(given[k]));
                long value = 0;
                if (!decimal || !CLI::detail::lexical_cast(given, value))
                    return "'" + given + "' is not a whole number in decimal digits, the first of which is not 0";
                if (value < least || value > most)
                    return given + " is not between " + std::to_string(least) + " and " + std::to_string(most);
                return std::string();
            },
            "", "whole_from"};
}
