#pragma once
#include "paints/files/column_roles.h"
#include "paints/files/paint_draft.h"

namespace paints {

/// Reads the colours of a table or of a file's named fields, and keeps in mind what is said of
/// them once.
class ColourCells {
 public:
  /// @param stated  the white by the file, if it says one; else that of a header or D65/2, noted
  ColourCells(PaintDraft& draft, const ReadChoices& choices,
              std::optional<spectra::StatedWhite> stated = {});

  /// The largest number of a kind decides on its scale: ask for each row before the first read.
  void measure(const ColourColumns& columns, const std::vector<std::string>& cells, bool comma);

  /// Nothing if the cells are empty, or after a fault.
  [[nodiscard]] std::optional<spectra::StatedColour> read(const ColourColumns& columns,
                                                          const std::vector<std::string>& cells,
                                                          const std::vector<DraftPlace>& places,
                                                          bool comma);

 private:
  [[nodiscard]] std::optional<Eigen::Vector3d> numbers(const ColourColumns& columns,
                                                       const std::vector<std::string>& cells,
                                                       const std::vector<DraftPlace>& places,
                                                       bool comma);
  [[nodiscard]] spectra::StatedWhite white_of(const ColourColumns& columns);
  [[nodiscard]] double full_scale(ColourColumns::Kind kind);
  void out_of_range(const DraftPlace& place, double value, const char* remedy);

  PaintDraft& draft_;
  const ReadChoices& choices_;
  std::optional<spectra::StatedWhite> stated_;
  double largest_[5] = {0, 0, 0, 0, 0};
  bool whole_[5] = {true, true, true, true, true};
  bool white_noted_ = false, scale_asked_ = false;
};

}  // namespace paints
