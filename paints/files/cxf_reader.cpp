// CxF3, ISO 17972-1.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <pugixml.hpp>
#include <set>

#include "paints/files/format_readers.h"
#include "paints/files/source_text.h"

namespace paints {
namespace {

using pugi::xml_node;

constexpr std::size_t kMaxBytes = std::size_t{64} << 20;
constexpr int kMaxDepth = 64;
constexpr std::size_t kMaxBands = 10'000;

/// A name without its prefix.
std::string_view local(const char* name) {
  const char* colon = std::strchr(name, ':');
  return colon == nullptr ? name : colon + 1;
}

bool is(const xml_node& node, std::string_view name) { return local(node.name()) == name; }

xml_node child(const xml_node& node, std::string_view name) {
  for (const xml_node& c : node.children()) {
    if (is(c, name)) return c;
  }
  return {};
}

std::string text_of(const xml_node& node) { return std::string(trimmed(node.child_value())); }

/// What a file says about how its spectra and colours were measured.
struct Specification {
  double start_nm = 0, step_nm = 0;  ///< 0: not said
  std::string condition;             ///< M1_Daylight, Specular_Included, ...
  std::optional<spectra::StatedWhite> white;
};

/// "D50" and "2_Degree"
std::optional<spectra::StatedWhite> white_of(const xml_node& tristimulus) {
  const std::string observer = text_of(child(tristimulus, "Observer"));
  return spectra::parse_white(text_of(child(tristimulus, "Illuminant")) + "/" +
                              observer.substr(0, observer.find('_')));
}

Specification specification_of(const xml_node& node) {
  Specification spec;
  const xml_node measured = child(node, "MeasurementSpec");
  const xml_node range = child(measured, "WavelengthRange");
  spec.start_nm = range.attribute("StartWL").as_double();
  spec.step_nm = range.attribute("Increment").as_double();
  std::vector<std::string> words;
  const xml_node geometry = child(measured, "GeometryChoice");
  for (const xml_node& g : geometry.children()) {
    words.push_back(text_of(g).empty() ? std::string(local(g.name())) : text_of(g));
  }
  const std::string light = text_of(child(child(measured, "Device"), "DeviceIllumination"));
  if (!light.empty()) words.push_back(light);
  spec.condition = fmt::format("{}", fmt::join(words, ", "));
  spec.white = white_of(child(node, "TristimulusSpec"));
  return spec;
}

class CxfReader {
 public:
  CxfReader(std::string_view text, const ReadChoices& choices, PaintDraft& draft)
      : text_(text), lines_(text), choices_(choices), draft_(draft) {}

  void read() {
    draft_.file.format = "CxF3";
    draft_.full_scale = 1;
    if (!parse() || !check_root()) return;
    const xml_node resources = child(root_, "Resources");
    for (const xml_node& s : child(resources, "ColorSpecificationCollection").children()) {
      specifications_[s.attribute("Id").value()] = specification_of(s);
    }
    for (const xml_node& object : child(resources, "ObjectCollection").children()) {
      if (is(object, "Object")) read_object(object);
    }
    tell();
  }

 private:
  DraftPlace place(const xml_node& node) const {
    const std::ptrdiff_t offset = node.offset_debug();
    return {.at = lines_.place(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0))),
            .pointer = std::string(local(node.name()))};
  }

  bool parse() {
    if (text_.size() > kMaxBytes) {
      draft_.fault({}, "XML larger than 64 MiB", "split the file");
      return false;
    }
    if (const std::size_t at = std::min(text_.find("<!DOCTYPE"), text_.find("<!ENTITY"));
        at != text_.npos) {
      draft_.fault({.at = lines_.place(at), .pointer = ""}, "a document type or entities",
                   "CxF3 has none: take them out");
      return false;
    }
    const pugi::xml_parse_result result =
        document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
      draft_.fault({.at = lines_.place(static_cast<std::size_t>(result.offset)), .pointer = ""},
                   fmt::format("no sound XML: {}", lower(result.description())),
                   "export the file anew");
      return false;
    }
    return check_depth();
  }

  bool check_depth() {
    int depth = 0;
    xml_node node = document_.first_child();
    while (node) {
      if (depth > kMaxDepth) {
        draft_.fault(place(node), fmt::format("elements nested deeper than {}", kMaxDepth),
                     "export the file anew");
        return false;
      }
      if (node.first_child()) {
        node = node.first_child();
        ++depth;
        continue;
      }
      while (node && !node.next_sibling()) {
        node = node.parent();
        --depth;
      }
      if (node) node = node.next_sibling();
    }
    return true;
  }

  bool check_root() {
    root_ = document_.document_element();
    if (is(root_, "CxF")) {
      bool core = false;
      for (const pugi::xml_attribute& a : root_.attributes()) {
        core = core || std::string_view(a.value()).find("CxF3-core") != std::string_view::npos;
      }
      draft_.file.rule = "XML with the root CxF";
      if (!core) draft_.note("the root does not name the namespace CxF3-core");
      return true;
    }
    const bool old = lower(local(root_.name())) == "cxf";
    draft_.fault(place(root_),
                 old ? "CxF of version 2" : fmt::format("XML with the root <{}>", root_.name()),
                 "export CxF3, CGATS or CSV");
    return false;
  }

  const Specification* specification(const xml_node& value) {
    const auto found = specifications_.find(value.attribute("ColorSpecification").value());
    return found == specifications_.end() ? nullptr : &found->second;
  }

  /// The spectra that are meant: with pick those of that specification, condition or name.
  std::vector<xml_node> spectra_of(const xml_node& values) {
    std::vector<xml_node> spectra;
    for (const xml_node& value : values.children()) {
      if (!is(value, "ReflectanceSpectrum") && !is(value, "CustomSpectrum")) continue;
      const std::string id = value.attribute("ColorSpecification").value();
      const Specification* spec = specification(value);
      const bool picked =
          choices_.pick.empty() || id == choices_.pick ||
          choices_.pick == value.attribute("Name").value() ||
          (spec != nullptr && spec->condition.find(choices_.pick) != std::string::npos);
      if (!picked) continue;
      spectra.push_back(value);
    }
    return spectra;
  }

  void read_object(const xml_node& object) {
    const xml_node values = child(object, "ColorValues");
    DraftPaint paint;
    paint.place = place(object);
    paint.name = object.attribute("Name").value();
    if (paint.name.empty()) paint.name = object.attribute("Id").value();
    const std::vector<xml_node> spectra = spectra_of(values);
    if (spectra.size() > 1) {
      std::vector<std::string> ids;
      for (const xml_node& s : spectra) ids.push_back(s.attribute("ColorSpecification").value());
      draft_.fault(paint.place,
                   fmt::format("\"{}\" has {} spectra: {}", paint.name, spectra.size(),
                               fmt::join(ids, ", ")),
                   "choose pick=" + ids.front() + " or another of them");
      return;
    }
    if (spectra.size() == 1) read_spectrum(spectra.front(), paint);
    read_colour(values, paint);
    if (paint.values.empty() && !paint.colour) {
      ++colourless_;
      return;
    }
    draft_.paints.push_back(std::move(paint));
  }

  void read_spectrum(const xml_node& node, DraftPaint& paint) {
    if (const Specification* spec = specification(node); spec != nullptr) {
      conditions_.insert(spec->condition);
    }
    if (is(node, "CustomSpectrum")) return read_custom(node, paint);
    std::string_view rest = node.child_value();
    while (!(rest = trimmed(rest)).empty()) {
      const std::size_t end = std::min(rest.find_first_of(" \t\r\n"), rest.size());
      const auto value = spectra::parse_number(rest.substr(0, end));
      if (!value || paint.values.size() == kMaxBands) {
        draft_.fault(place(node),
                     value ? fmt::format("more than {} values", kMaxBands)
                           : fmt::format("\"{}\" is not a number",
                                         rest.substr(0, std::min<std::size_t>(end, 40))),
                     "give finite numbers with blanks between them");
        return;
      }
      paint.values.push_back(*value);
      rest.remove_prefix(end);
    }
    paint.value_at.assign(paint.values.size(), place(node).at);
    set_wavelengths(node, paint);
  }

  void read_custom(const xml_node& node, DraftPaint& paint) {
    std::map<double, double> points;
    for (const xml_node& point : node.children()) {
      if (!is(point, "SpectralPoint")) continue;
      const auto nm = spectra::parse_number(point.attribute("WL").value()),
                 value = spectra::parse_number(point.child_value());
      if (!nm || !value || points.size() == kMaxBands) {
        draft_.fault(place(point), "no wavelength or no value", "give WL=\"400\" and a number");
        return;
      }
      const auto [known, is_new] = points.try_emplace(*nm, *value);
      if (!is_new && known->second != *value) {
        draft_.fault(place(point), fmt::format("{} nm again, with another value", *nm),
                     "give each wavelength once");
      }
    }
    for (const auto& [nm, value] : points) {
      paint.nm.push_back(nm);
      paint.values.push_back(value);
    }
    paint.value_at.assign(paint.values.size(), place(node).at);
  }

  void set_wavelengths(const xml_node& node, DraftPaint& paint) {
    const std::size_t count = paint.values.size();
    const Specification* spec = specification(node);
    double start = spec == nullptr ? 0 : spec->start_nm, step = spec == nullptr ? 0 : spec->step_nm;
    if (node.attribute("StartWL")) start = node.attribute("StartWL").as_double();
    if (choices_.wavelengths) {
      start = choices_.wavelengths->first_nm;
      step = choices_.wavelengths->step_nm;
    } else if (step == 0) {
      const std::map<std::size_t, double> usual{{31, 400}, {36, 380}, {39, 360}};
      const auto known = usual.find(count);
      if (known != usual.end() && (start == 0 || start == known->second)) {
        start = known->second;
        step = 10;
        usual_ = count;
      }
    }
    if (!(start >= 200 && start <= 2500 && step >= 0.1 && step <= 100) || count == 0) {
      draft_.fault(place(node), fmt::format("{} values without wavelengths", count),
                   "choose wavelengths=FIRST:LAST:STEP in nm");
      paint.values.clear();
      return;
    }
    for (std::size_t k = 0; k < count; ++k)
      paint.nm.push_back(start + static_cast<double>(k) * step);
  }

  std::optional<Eigen::Vector3d> three(const xml_node& node, const char* a, const char* b,
                                       const char* c) {
    Eigen::Vector3d v;
    int i = 0;
    for (const char* name : {a, b, c}) {
      const auto value = spectra::parse_number(child(node, name).child_value());
      if (!value) {
        draft_.fault(place(node), fmt::format("{} is missing or no number", name),
                     "give a finite number");
        return {};
      }
      v[i++] = *value;
    }
    return v;
  }

  spectra::StatedWhite white(const xml_node& node) {
    if (choices_.white) return *choices_.white;
    const Specification* spec = specification(node);
    if (spec != nullptr && spec->white) return *spec->white;
    white_assumed_ = true;
    return {};
  }

  void read_colour(const xml_node& values, DraftPaint& paint) {
    if (const xml_node lab = child(values, "ColorCIELab"); lab) {
      const auto v = three(lab, "L", "A", "B");
      if (!v) return;
      if ((*v)[0] >= 0 && (*v)[0] <= 100 && v->cwiseAbs().maxCoeff() <= 200) {
        paint.colour = spectra::from_lab(*v, white(lab));
      } else {
        draft_.fault(place(lab), "L, A or B is out of range", "give L 0..100, A and B within 200");
      }
    } else if (const xml_node xyz = child(values, "ColorCIEXYZ"); xyz) {
      const auto v = three(xyz, "X", "Y", "Z");
      if (!v) return;
      if (v->minCoeff() >= 0 && v->maxCoeff() <= 200) {
        paint.colour = spectra::from_xyz({(*v)[0], (*v)[1], (*v)[2]}, white(xyz));
      } else {
        draft_.fault(place(xyz), "X, Y or Z is out of range", "give them for a white of Y = 100");
      }
    } else if (const xml_node rgb = child(values, "ColorSRGB"); rgb) {
      const auto v = three(rgb, "R", "G", "B");
      const double most = rgb.attribute("MaxRange").as_double(255);
      if (!v) return;
      if (most > 0 && v->minCoeff() >= 0 && v->maxCoeff() <= most) {
        paint.colour = spectra::from_srgb(*v / most);
      } else {
        draft_.fault(place(rgb), "R, G or B is out of range", fmt::format("give 0..{}", most));
      }
    }
  }

  void tell() {
    if (draft_.paints.empty() && draft_.faults.empty()) {
      draft_.fault({},
                   choices_.pick.empty() ? "no object has a spectrum or a colour"
                                         : "no spectrum is \"" + choices_.pick + "\"",
                   "give ReflectanceSpectrum, ColorCIELab, ColorCIEXYZ or ColorSRGB");
    }
    conditions_.erase("");
    if (!conditions_.empty()) {
      draft_.note(fmt::format("measured with {}", fmt::join(conditions_, "; ")));
    }
    if (colourless_ > 0) draft_.note(fmt::format("{} objects have no colour", colourless_));
    if (usual_ > 0) {
      draft_.note(
          fmt::format("no increment is given: {} values were taken in steps of 10 nm", usual_));
    }
    if (white_assumed_) draft_.note("no white is stated for the colours; D65/2 was taken");
  }

  std::string_view text_;
  LineIndex lines_;
  const ReadChoices& choices_;
  PaintDraft& draft_;
  pugi::xml_document document_;
  xml_node root_;
  std::map<std::string, Specification> specifications_;
  std::set<std::string> conditions_;
  int colourless_ = 0;
  std::size_t usual_ = 0;
  bool white_assumed_ = false;
};

}  // namespace

bool is_xml(std::string_view text) { return trimmed(text).starts_with('<'); }

void read_cxf(std::string_view text, const ReadChoices& choices, PaintDraft& draft) {
  CxfReader(text, choices, draft).read();
}

}  // namespace paints
