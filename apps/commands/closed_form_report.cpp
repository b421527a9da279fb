#include "apps/commands/closed_form_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/reports/csv.h"
#include "apps/run/run_record.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

std::string radiosity_csv(const ClosedFormReport& report) {
  CsvText csv(fmt::format("nm,{}", fmt::join(report.part_names, ",")));
  for (Eigen::Index k = 0; k < report.radiosity.cols(); ++k) {
    csv.cell(spectra::kClosedFormGrid.wavelength_nm(static_cast<int>(k)));
    for (const double part : report.radiosity.col(k)) csv.cell(part);
    csv.end_row();
  }
  return csv.take();
}

const char* to_string(solver::Reach reach) {
  switch (reach) {
    case solver::Reach::attained:
      return "attained";
    case solver::Reach::too_dark:
      return "too dark";
    case solver::Reach::too_bright:
      return "too bright";
  }
  throw std::invalid_argument("unknown reach");
}

std::string wished_csv(const AnsweredWish& wish, const solver::Parts& radiosity) {
  CsvText csv("nm,wished,least,limit,reflectance,radiosity,reach");
  for (Eigen::Index k = 0; k < radiosity.cols(); ++k) {
    csv.cell(spectra::kClosedFormGrid.wavelength_nm(static_cast<int>(k)));
    csv.cell(wish.wished.radiosity.values[k]);
    csv.cell(wish.inverse.least[k]).cell(wish.inverse.limit[k]).cell(wish.inverse.reflectance[k]);
    csv.cell(radiosity(wish.wished.of, k))
        .cell(to_string(wish.inverse.reach[static_cast<std::size_t>(k)]));
    csv.end_row();
  }
  return csv.take();
}

/// Wavelengths of a reach, as [first, last] of each run.
Json ranges_nm(const std::vector<solver::Reach>& all, solver::Reach reach) {
  Json ranges = Json::array();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k] != reach) continue;
    const double nm = spectra::kClosedFormGrid.wavelength_nm(static_cast<int>(k));
    if (k == 0 || all[k - 1] != reach) ranges.push_back({nm, nm});
    ranges.back()[1] = nm;
  }
  return ranges;
}

Json describe(const AnsweredWish& wish) {
  const std::vector<solver::Reach>& reach = wish.inverse.reach;
  return {{"of", wish.of},
          {"by", wish.by},
          {"wavelengths", reach.size()},
          {"attained", std::ranges::count(reach, solver::Reach::attained)},
          {"too_dark_nm", ranges_nm(reach, solver::Reach::too_dark)},
          {"too_bright_nm", ranges_nm(reach, solver::Reach::too_bright)}};
}

std::string in_words(const Json& ranges) {
  std::string words;
  for (const Json& range : ranges) {
    words += fmt::format("{}{}..{}", words.empty() ? "" : ", ", range[0].get<double>(),
                         range[1].get<double>());
  }
  return words;
}

std::vector<std::string> notes_on(const Json& wish) {
  std::vector<std::string> notes{
      fmt::format("the wished radiosity of {} is attained by {} at {} of {} wavelengths",
                  wish["of"].get<std::string>(), wish["by"].get<std::string>(),
                  wish["attained"].get<int>(), wish["wavelengths"].get<int>())};
  if (!wish["too_dark_nm"].empty()) {
    notes.push_back(fmt::format("darker than with reflectance 0, which is written: {} nm",
                                in_words(wish["too_dark_nm"])));
  }
  if (!wish["too_bright_nm"].empty()) {
    notes.push_back(fmt::format(
        "as bright as with reflectance 1 or brighter, the last number below 1 is written: {} nm",
        in_words(wish["too_bright_nm"])));
  }
  return notes;
}

}  // namespace

std::optional<AnsweredWish> answer(const std::optional<scenes::WishedPart>& wished,
                                   std::span<const char* const> part_names, const Inverse& inverse,
                                   solver::Parts& reflectance) {
  if (!wished) return std::nullopt;
  AnsweredWish wish{
      .wished = *wished,
      .of = part_names[static_cast<std::size_t>(wished->of)],
      .by = part_names[static_cast<std::size_t>(wished->by)],
      .inverse =
          inverse({.of = wished->of, .by = wished->by, .radiosity = wished->radiosity.values})};
  reflectance.row(wished->by) = wish.inverse.reflectance.transpose();
  return wish;
}

solver::Parts parts_of(std::span<const spectra::Spectrum> spectra) {
  solver::Parts parts(spectra.size(), spectra::kClosedFormGrid.count);
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    parts.row(static_cast<Eigen::Index>(i)) = spectra[i].values.transpose();
  }
  return parts;
}

void write_report(const ClosedFormReport& report, const FileCommand& command,
                  const Session& session) {
  const std::filesystem::path out = command.out;
  Json record = begin_record(run_identity(report.subcommand, command.in, Json::object()), session);
  record["grid"] = describe(spectra::kClosedFormGrid);
  record["form_factors"] = report.form_factors;
  record["notes"] = report.notes;
  std::vector<OutputFile> files{{.path = out / "radiosity.csv", .text = radiosity_csv(report)}};
  std::vector<std::string> notes = report.notes;
  if (report.wish) {
    const AnsweredWish& wish = *report.wish;
    record["wished"] = describe(wish);
    for (std::string& note : notes_on(record["wished"])) notes.push_back(std::move(note));
    files.push_back({.path = out / "wished.csv", .text = wished_csv(wish, report.radiosity)});
    files.push_back({.path = out / "reflectance.csv",
                     .text = reflectances_csv(
                         {{wish.by, {spectra::kClosedFormGrid, wish.inverse.reflectance}}})});
  }
  record["status"] = "done";
  record["peak_memory_bytes"] = peak_memory_bytes();
  files.push_back(run_json(out, record));
  write_files(files);
  report_notes(notes);
  report_written(files);
  if (session.json) put(record.dump(2) + "\n");
}

}  // namespace apps
