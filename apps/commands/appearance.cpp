#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "appearance/ciecam02.h"
#include "appearance/spectra/text/csv_reader.h"
#include "apps/commands/commands.h"
#include "apps/reports/colour_reports.h"
#include "apps/reports/csv.h"
#include "apps/run/run_record.h"
#include "apps/system/output_files.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

using Names = std::vector<std::string>;

const Names kStimulus{"X", "Y", "Z"};
const Names kWished{"J", "C", "h_deg"};
const Names kConditions{"Xw", "Yw", "Zw", "L_A", "Y_b", "F", "c", "N_c"};
const Names kCorrelates{"J",   "C",   "h_deg", "H",   "Q",
                        "M",   "s",   "a_C",   "b_C", "status",
                        "a_M", "b_M", "a_s",   "b_s", "hue_composition"};
const Names kInverted{"X", "Y", "Z", "status"};
constexpr std::string_view kDomain = "DOMAIN";

/// The columns of a table by name; every one that is missing is a fault.
std::vector<std::size_t> columns_of(const spectra::CsvTable& table, const Names& names) {
  std::vector<std::size_t> columns;
  std::vector<spectra::Fault> faults;
  for (const std::string& name : names) {
    const auto at = std::find(table.header.begin(), table.header.end(), name);
    columns.push_back(static_cast<std::size_t>(at - table.header.begin()));
    if (at == table.header.end()) {
      faults.push_back({.file = table.path,
                        .line = 1,
                        .column = 1,
                        .pointer = name,
                        .problem = "the column is missing",
                        .remedy = fmt::format("the columns read are {}", fmt::join(names, ","))});
    }
  }
  if (!faults.empty()) throw spectra::InputError(faults);
  return columns;
}

/// nan and inf are numbers here: the model answers them with DOMAIN.
std::optional<double> number_in(const std::string& cell) {
  if (const auto number = spectra::parse_number(cell)) return number;
  double value = 0;
  const char* end = cell.data() + cell.size();
  const auto [stop, error] = std::from_chars(cell.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

using Inputs = std::array<double, 11>;  // three of the colour, then kConditions

/// Every row as numbers. `gaps`: an empty cell of the colour reads as NaN, because the forward
/// model leaves undefined correlates empty.
std::vector<Inputs> numbers_of(const spectra::CsvTable& table, const Names& names, bool gaps) {
  const std::vector<std::size_t> columns = columns_of(table, names);
  std::vector<spectra::Fault> faults;
  std::vector<Inputs> rows(table.rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::string& cell = table.rows[i].cells[columns[k]];
      const bool gap = gaps && k < kWished.size() && cell.empty();
      const auto number = gap ? std::numeric_limits<double>::quiet_NaN() : number_in(cell);
      if (!number) {
        faults.push_back(spectra::cell_fault(table, table.rows[i], columns[k],
                                             fmt::format("\"{}\" is no number", cell),
                                             "give a decimal number, e.g. 19.01"));
      }
      rows[i][k] = number.value_or(0);
    }
  }
  if (!faults.empty()) throw spectra::InputError(faults);
  return rows;
}

appearance::Adaptation adaptation_of(const Inputs& in) {
  return appearance::adapt({.white = {in[3], in[4], in[5]},
                            .adapting_luminance_cd_m2 = in[6],
                            .background_y = in[7],
                            .surround = {.f = in[8], .c = in[9], .n_c = in[10]}});
}

void forward_cells(CsvText& csv, const Inputs& in) {
  try {
    const auto k = appearance::ciecam02_forward({in[0], in[1], in[2]}, adaptation_of(in));
    const Reported r(k);
    csv.cell(r.j).cell(r.c).cell(r.h_deg).cell(r.hue_quadrature).cell(r.q).cell(r.m).cell(r.s);
    csv.cell(r.a_c).cell(r.b_c).cell(appearance::to_string(k.status));
    csv.cell(r.a_m).cell(r.b_m).cell(r.a_s).cell(r.b_s);
    csv.cell(appearance::hue_composition(k.hue_quadrature));
  } catch (const std::domain_error&) {
    for (const std::string& name : kCorrelates) csv.cell(name == "status" ? kDomain : "");
  }
}

void inverse_cells(CsvText& csv, const Inputs& in) {
  try {
    const auto xyz = appearance::ciecam02_inverse(
        {.lightness = in[0], .chroma = in[1], .hue_deg = in[2]}, adaptation_of(in));
    csv.cell(xyz.x).cell(xyz.y).cell(xyz.z).cell("OK");
  } catch (const std::domain_error&) {
    for (const std::string& name : kInverted) csv.cell(name == "status" ? kDomain : "");
  }
}

/// A column of the input that the command computes anew is dropped; all others are kept.
std::vector<std::size_t> kept_columns(const spectra::CsvTable& table, const Names& computed) {
  std::vector<std::size_t> kept;
  Names dropped;
  for (std::size_t k = 0; k < table.header.size(); ++k) {
    const std::string& name = table.header[k];
    if (std::find(computed.begin(), computed.end(), name) == computed.end()) {
      kept.push_back(k);
    } else {
      dropped.push_back(name);
    }
  }
  if (!dropped.empty()) {
    report_notes({fmt::format("computed anew, not kept: {}", fmt::join(dropped, ", "))});
  }
  return kept;
}

std::string convert(const spectra::CsvTable& table, bool inverse) {
  Names names = inverse ? kWished : kStimulus;
  names.insert(names.end(), kConditions.begin(), kConditions.end());
  const std::vector<Inputs> rows = numbers_of(table, names, inverse);
  const Names& computed = inverse ? kInverted : kCorrelates;
  const std::vector<std::size_t> kept = kept_columns(table, computed);

  CsvText csv;
  for (const std::size_t k : kept) csv.cell(table.header[k]);
  for (const std::string& name : computed) csv.cell(name);
  csv.end_row();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const std::size_t k : kept) csv.cell(table.rows[i].cells[k]);
    inverse ? inverse_cells(csv, rows[i]) : forward_cells(csv, rows[i]);
    csv.end_row();
  }
  return csv.take();
}

}  // namespace

Exit convert_table(const FileCommand& command, const Session& session) {
  const spectra::CsvTable table = spectra::read_csv(command.in);
  const std::vector<OutputFile> files{
      {.path = command.out, .text = convert(table, command.inverse)}};
  write_files(files);
  report_written(files);
  if (session.json) {
    put(Json{{"rows", table.rows.size()}, {"file", command.out}}.dump(2) + "\n");
  }
  return Exit::done;
}

}  // namespace apps
