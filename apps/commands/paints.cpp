#include <fmt/format.h>

#include <algorithm>

#include "apps/commands/commands.h"
#include "apps/reports/paint_exports.h"
#include "apps/run/run_record.h"
#include "apps/system/output_files.h"
#include "apps/system/terminal.h"
#include "paints/files/paint_reader.h"

namespace apps {
namespace {

const char* kind_of(const paints::FilePaint& paint) {
  if (paint.reconstructed) return "reconstructed";
  return paint.fluorescent ? "fluorescence cut" : "measured";
}

/// What was recognised, assumed and found odd.
std::vector<std::string> remarks(const paints::PaintFile& file,
                                 const std::vector<paints::ListedPaint>& listed) {
  std::vector<std::string> notes{fmt::format("{}: {} paints, read as {}: {}", file.path,
                                             file.paints.size(), file.format, file.rule)};
  if (file.percent) notes.emplace_back("reflectances are in percent; divided by 100");
  notes.insert(notes.end(), file.notes.begin(), file.notes.end());
  const auto doubles = paints::duplicates(file);
  if (!doubles.empty()) {
    const auto& [later, earlier] = doubles.front();
    notes.push_back(fmt::format("{} paints are the same as an earlier one, \"{}\" as \"{}\" first",
                                doubles.size(), file.paints[later].name,
                                file.paints[earlier].name));
  }
  const auto outside = std::count_if(listed.begin(), listed.end(),
                                     [](const paints::ListedPaint& p) { return !p.in_srgb; });
  if (outside > 0)
    notes.push_back(fmt::format("{} colours are outside sRGB: their hex is cut", outside));
  return notes;
}

std::string listing(const paints::PaintFile& file, const std::vector<paints::ListedPaint>& listed) {
  std::vector<std::vector<std::string>> rows{
      {"paint", "label", "X", "Y = LRV", "Z", "L*", "a*", "b*", "hex", "spectrum"}};
  const auto number = [](double value) { return fmt::format("{:.2f}", value); };
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const paints::ListedPaint& p = listed[i];
    rows.push_back({file.paints[i].name, file.paints[i].label, number(p.xyz.x), number(p.xyz.y),
                    number(p.xyz.z), number(p.lab.l), number(p.lab.a), number(p.lab.b),
                    paints::hex_code(p), kind_of(file.paints[i])});
  }
  return table("<<>>>>>><<", rows) + "\nunder D65, 2 degree observer\n";
}

Json data_of(const paints::PaintFile& file, const std::vector<paints::ListedPaint>& listed,
             const std::vector<std::string>& notes) {
  Json list = Json::array();
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const paints::ListedPaint& p = listed[i];
    const paints::FilePaint& paint = file.paints[i];
    list.push_back({{"paint", paint.name},
                    {"label", paint.label},
                    {"XYZ", {p.xyz.x, p.xyz.y, p.xyz.z}},
                    {"Lab", {p.lab.l, p.lab.a, p.lab.b}},
                    {"LRV_stated", paint.lrv ? Json(*paint.lrv) : Json()},
                    {"hex", paints::hex_code(p)},
                    {"spectrum", kind_of(paint)}});
  }
  return {{"file", file.path}, {"format", file.format}, {"rule", file.rule},
          {"notes", notes},    {"white", "D65/2"},      {"paints", list}};
}

}  // namespace

Exit list_paints(const FileCommand& command, const Session& session) {
  const paints::PaintFile file = paints::read_paint_file(command.in);
  const std::vector<paints::ListedPaint> listed = paints::listed(file);
  const std::vector<std::string> notes = remarks(file, listed);
  report_notes(notes);
  if (!command.out.empty()) {
    const PaintExport format = export_by_name(command.out);
    const std::vector<OutputFile> files{
        {.path = command.out, .text = exported(format, file, listed)}};
    write_files(files);
    report_written(files);
  }
  put(session.json ? data_of(file, listed, notes).dump(2) + "\n" : listing(file, listed));
  return Exit::done;
}

}  // namespace apps
