#pragma once
#include <CLI/CLI.hpp>  // seconds of compile time: for command_line.cpp alone
#include <cmath>

namespace apps {

/// Unlike CLI::PositiveNumber, refuses nan and infinity too.
inline const CLI::Validator kPositive(
    [](const std::string& text) {
      double value = 0;
      const bool good = CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value > 0;
      return good ? std::string() : text + " is no number above 0";
    },
    "ABOVE 0");

inline const CLI::Validator kNotNegative(
    [](const std::string& text) {
      double value = 0;
      const bool good =
          CLI::detail::lexical_cast(text, value) && std::isfinite(value) && value >= 0;
      return good ? std::string() : text + " is no number from 0";
    },
    "FROM 0");

inline const CLI::Validator kNamed(
    [](const std::string& text) { return text.empty() ? "a path that is empty" : std::string(); },
    "PATH");

/// 0 to below 1, as a share of light.
inline const CLI::Validator kShare(
    [](const std::string& text) {
      double value = 0;
      const bool good = CLI::detail::lexical_cast(text, value) && value >= 0 && value < 1;
      return good ? std::string() : text + " is no number from 0 to below 1";
    },
    "SHARE");

/// Unlike CLI::Range, refuses nan too.
inline CLI::Validator within(double least, double most) {
  return {[=](const std::string& text) {
            double value = 0;
            const bool good =
                CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return good ? std::string() : text + " is not within the range";
          },
          "FROM " + CLI::detail::to_string(least) + " TO " + CLI::detail::to_string(most)};
}

/// A step that divides 100 parts.
inline const CLI::Validator kStep(
    [](const std::string& text) {
      double value = 0;
      const bool number = CLI::detail::lexical_cast(text, value) && value >= 0.01 && value <= 100;
      const bool good = number && std::abs(100 / value - std::round(100 / value)) < 1e-9;
      return good ? std::string() : text + " does not divide 100 parts, or is below 0.01";
    },
    "PARTS");

}  // namespace apps
