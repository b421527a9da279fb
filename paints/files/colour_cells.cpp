#include "paints/files/colour_cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paints {
namespace {

using Kind = ColourColumns::Kind;

constexpr double kFractionUpTo = 1.2;

}  // namespace

ColourCells::ColourCells(PaintDraft& draft, const ReadChoices& choices,
                         std::optional<spectra::StatedWhite> stated)
    : draft_(draft), choices_(choices), stated_(std::move(stated)) {}

void ColourCells::measure(const ColourColumns& columns, const std::vector<std::string>& cells,
                          bool comma) {
  if (columns.kind == Kind::hex || columns.kind == Kind::lab) return;
  const auto kind = static_cast<std::size_t>(columns.kind);
  const std::size_t first = columns.kind == Kind::xy_y ? 2 : 0;  // x and y are below 1 anyway
  for (std::size_t i = first; i < columns.columns.size(); ++i) {
    if (columns.columns[i] >= cells.size()) continue;
    const double value = parse_decimal(cells[columns.columns[i]], comma).value_or(0);
    largest_[kind] = std::max(largest_[kind], value);
    whole_[kind] = whole_[kind] && value == std::floor(value);
  }
}

double ColourCells::full_scale(Kind kind) {
  const double most = kind == Kind::rgb ? 255 : 100;
  const auto k = static_cast<std::size_t>(kind);
  if (choices_.full_scale == 1) return 1;
  if (choices_.full_scale > 1 || largest_[k] > kFractionUpTo) return most;
  if (kind == Kind::rgb && !whole_[k]) return 1;
  if (!scale_asked_) {
    draft_.fault(
        {},
        fmt::format("no {} is above {}: 0 to 1, or 0 to {}?", to_string(kind), largest_[k], most),
        "choose scale=fraction or scale=percent");
    scale_asked_ = true;
  }
  return most;
}

spectra::StatedWhite ColourCells::white_of(const ColourColumns& columns) {
  if (choices_.white) return *choices_.white;
  if (columns.white) return *columns.white;
  if (stated_) return *stated_;
  if (!white_noted_) {
    draft_.note(fmt::format("no white is stated for {}; taken as D65/2 (white=... says otherwise)",
                            to_string(columns.kind)));
    white_noted_ = true;
  }
  return {};
}

void ColourCells::out_of_range(const DraftPlace& place, double value, const char* remedy) {
  draft_.fault(place, fmt::format("{} is out of range", value), remedy);
}

std::optional<Eigen::Vector3d> ColourCells::numbers(const ColourColumns& columns,
                                                    const std::vector<std::string>& cells,
                                                    const std::vector<DraftPlace>& places,
                                                    bool comma) {
  Eigen::Vector3d values;
  bool readable = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t c = columns.columns[i];
    const auto value = parse_decimal(cells[c], comma);
    if (!value) {
      draft_.fault(places[c], fmt::format("\"{}\" is not a number", cells[c]),
                   "give a finite number");
      readable = false;
    }
    values[static_cast<Eigen::Index>(i)] = value.value_or(0);
  }
  if (!readable) return {};
  return values;
}

std::optional<spectra::StatedColour> ColourCells::read(const ColourColumns& columns,
                                                       const std::vector<std::string>& cells,
                                                       const std::vector<DraftPlace>& places,
                                                       bool comma) {
  const auto empty = [&](std::size_t c) { return c >= cells.size() || cells[c].empty(); };
  if (std::all_of(columns.columns.begin(), columns.columns.end(), empty)) return {};
  const DraftPlace& place = places[columns.columns[0]];
  if (columns.kind == Kind::hex) {
    const std::string& cell = cells[columns.columns[0]];
    if (const auto rgb = spectra::parse_hex(cell)) return spectra::from_srgb(*rgb);
    draft_.fault(place, fmt::format("\"{}\" is no hex colour", cell), "give one like #D8C9A7");
    return {};
  }
  const auto values = numbers(columns, cells, places, comma);
  if (!values) return {};
  const Eigen::Vector3d& v = *values;
  if (columns.kind == Kind::lab) {
    if (v[0] >= 0 && v[0] <= 100 && v.tail<2>().cwiseAbs().maxCoeff() <= 200) {
      return spectra::from_lab(v, white_of(columns));
    }
    out_of_range(place, v.cwiseAbs().maxCoeff(), "give L* from 0 to 100, a* and b* within 200");
    return {};
  }
  const double scale = full_scale(columns.kind);
  if (columns.kind == Kind::rgb) {
    if (v.minCoeff() >= 0 && v.maxCoeff() <= scale) return spectra::from_srgb(v / scale);
    out_of_range(place, v.minCoeff() < 0 ? v.minCoeff() : v.maxCoeff(),
                 "give R, G, B within 0..255");
    return {};
  }
  if (!(v.minCoeff() >= 0 && v.maxCoeff() <= 200)) {
    out_of_range(place, v.minCoeff() < 0 ? v.minCoeff() : v.maxCoeff(),
                 "give X, Y, Z relative to a white of Y = 100");
    return {};
  }
  const double m = 100 / scale;
  if (columns.kind == Kind::xyz) {
    return spectra::from_xyz({m * v[0], m * v[1], m * v[2]}, white_of(columns));
  }
  if (v[1] > 0 && v[0] + v[1] <= 1) {
    return spectra::from_xy_y(v[0], v[1], m * v[2], white_of(columns));
  }
  out_of_range(place, v[1] > 0 ? v[0] : v[1], "give a chromaticity: y above 0, x + y up to 1");
  return {};
}

}  // namespace paints
