#include "apps/reports/paint_exports.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "appearance/spectra/text/input_error.h"
#include "apps/reports/csv.h"

namespace apps {
namespace {

using paints::FilePaint;
using paints::ListedPaint;
using paints::PaintFile;

spectra::Spectrum on_bands(const FilePaint& paint) {
  return spectra::reflectance_on(spectra::kTransportGrid, paint.reflectance);
}

const char* kind_of(const FilePaint& paint) {
  if (paint.reconstructed) return "reconstructed";
  return paint.fluorescent ? "fluorescence cut" : "measured";
}

std::string as_csv(const PaintFile& file) {
  CsvText rows;
  rows.cell("name").cell("label").cell("spectrum");
  const spectra::Grid& grid = spectra::kTransportGrid;
  for (int k = 0; k < grid.count; ++k) rows.cell(grid.wavelength_nm(k));
  rows.end_row();
  for (const FilePaint& paint : file.paints) {
    rows.cell(paint.name).cell(paint.label).cell(kind_of(paint));
    for (const double value : on_bands(paint).values) rows.cell(value);
    rows.end_row();
  }
  return rows.take();
}

std::string xml_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) safe += c;
    }
  }
  return safe;
}

std::string as_cxf(const PaintFile& file) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<cc:CxF xmlns:cc=\"http://colorexchangeformat.com/CxF3-core\">\n"
      "  <cc:FileInformation>\n    <cc:Creator>roomhue</cc:Creator>\n"
      "    <cc:CreationDate>1970-01-01T00:00:00Z</cc:CreationDate>\n"
      "    <cc:Description>paints</cc:Description>\n  </cc:FileInformation>\n"
      "  <cc:Resources>\n    <cc:ObjectCollection>\n";
  int id = 0;
  for (const FilePaint& paint : file.paints) {
    text += fmt::format(
        "      <cc:Object ObjectType=\"Standard\" Name=\"{}\" Id=\"c{}\">\n"
        "        <cc:ColorValues>\n          <cc:ReflectanceSpectrum ColorSpecification=\"{}\" "
        "StartWL=\"400\">",
        xml_text(paint.name), ++id, paint.reconstructed ? "reconstructed" : "measured");
    const char* separator = "";
    for (const double value : on_bands(paint).values) {
      text += fmt::format("{}{}", separator, value);
      separator = " ";
    }
    text += "</cc:ReflectanceSpectrum>\n        </cc:ColorValues>\n      </cc:Object>\n";
  }
  text += "    </cc:ObjectCollection>\n    <cc:ColorSpecificationCollection>\n";
  for (const char* kind : {"measured", "reconstructed"}) {
    text += fmt::format(
        "      <cc:ColorSpecification Id=\"{}\">\n        <cc:MeasurementSpec>\n"
        "          <cc:MeasurementType>Spectrum_Reflectance</cc:MeasurementType>\n"
        "          <cc:WavelengthRange StartWL=\"400\" Increment=\"10\"/>\n"
        "        </cc:MeasurementSpec>\n      </cc:ColorSpecification>\n",
        kind);
  }
  return text + "    </cc:ColorSpecificationCollection>\n  </cc:Resources>\n</cc:CxF>\n";
}

std::string as_gpl(const PaintFile& file, const std::vector<ListedPaint>& listed) {
  std::string text = "GIMP Palette\nName: " + std::filesystem::path(file.path).stem().string() +
                     "\nColumns: 0\n# sRGB as seen under D65\n";
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const auto byte = [&](Eigen::Index c) { return std::lround(255 * listed[i].srgb[c]); };
    text += fmt::format("{:3} {:3} {:3}\t{}{}\n", byte(0), byte(1), byte(2), file.paints[i].name,
                        file.paints[i].reconstructed ? " (reconstructed)" : "");
  }
  return text;
}

/// Numbers with the highest byte first.
template <typename Number>
void put_big_endian(std::string& bytes, Number number) {
  for (int shift = 8 * (static_cast<int>(sizeof number) - 1); shift >= 0; shift -= 8) {
    bytes += static_cast<char>(number >> shift & 0xFF);
  }
}

/// UTF-8 to UTF-16; what lies beyond 16 bits becomes '?'.
std::u16string utf16(const std::string& text) {
  std::u16string wide;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t more = lead < 0xC0 ? 0 : lead < 0xE0 ? 1 : lead < 0xF0 ? 2 : 3;
    unsigned code = more == 0 ? lead : lead & (0x3FU >> more);
    for (std::size_t k = 1; k <= more && i + k < text.size(); ++k) {
      code = code << 6U | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    }
    wide += code > 0xFFFF ? u'?' : static_cast<char16_t>(code);
    i += more + 1;
  }
  return wide;
}

std::string as_ase(const PaintFile& file, const std::vector<ListedPaint>& listed) {
  constexpr std::uint16_t kVersion = 1, kColour = 1, kNormal = 2;
  std::string bytes = "ASEF";
  put_big_endian(bytes, kVersion);
  put_big_endian(bytes, std::uint16_t{0});
  put_big_endian(bytes, static_cast<std::uint32_t>(listed.size()));
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const std::u16string name = utf16(file.paints[i].name);
    std::string block;
    put_big_endian(block, static_cast<std::uint16_t>(name.size() + 1));
    for (const char16_t c : name) put_big_endian(block, static_cast<std::uint16_t>(c));
    put_big_endian(block, std::uint16_t{0});
    block += "RGB ";
    for (const double c : listed[i].srgb) {
      put_big_endian(block, std::bit_cast<std::uint32_t>(static_cast<float>(c)));
    }
    put_big_endian(block, kNormal);
    put_big_endian(bytes, kColour);
    put_big_endian(bytes, static_cast<std::uint32_t>(block.size()));
    bytes += block;
  }
  return bytes;
}

}  // namespace

PaintExport export_by_name(const std::string& path) {
  const std::string end = std::filesystem::path(path).extension().string();
  if (end == ".csv") return PaintExport::csv;
  if (end == ".cxf") return PaintExport::cxf;
  if (end == ".ase") return PaintExport::ase;
  if (end == ".gpl") return PaintExport::gpl;
  throw spectra::FileError(
      fmt::format("{}: paints are written as .csv, .cxf, .ase or .gpl, by the name's end", path));
}

std::string exported(PaintExport format, const PaintFile& file,
                     const std::vector<ListedPaint>& listed) {
  switch (format) {
    case PaintExport::csv:
      return as_csv(file);
    case PaintExport::cxf:
      return as_cxf(file);
    case PaintExport::ase:
      return as_ase(file, listed);
    case PaintExport::gpl:
      return as_gpl(file, listed);
  }
  return {};
}

}  // namespace apps
