#include "apps/closed_form_report.h"

#include <fmt/format.h>

#include "apps/csv.h"
#include "apps/run_record.h"

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

}  // namespace

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
  record["status"] = "done";
  record["peak_memory_bytes"] = peak_memory_bytes();
  const std::vector<OutputFile> files{
      {.path = out / "radiosity.csv", .text = radiosity_csv(report)}, run_json(out, record)};
  write_files(files);
  report_notes(report.notes);
  report_written(files);
  if (session.json) fmt::print("{}\n", record.dump(2));
}

}  // namespace apps
