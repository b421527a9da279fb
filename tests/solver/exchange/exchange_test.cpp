#include "solver/exchange/exchange.h"

#include <gtest/gtest.h>

#include <string>

#include "scenes/files/room_json.h"
#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

scenes::PatchMesh sample_mesh(const std::string& name) {
  const std::string file = std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json";
  return scenes::mesh_room(scenes::read_room(file), 0.4);
}

// The rows of a closed room sum to the areas: nothing but rounding to float is left to mend.
TEST(Exchange, EmptyRoomClosesToRounding) {
  const ExchangeAreas exchange = compute_exchange(sample_mesh("box"), Visibility());
  EXPECT_LT(exchange.largest_scaling, 3e-8);
  EXPECT_LT(exchange.closure_defect, 1e-14);
}

// Furniture, one piece of it turned: near, far, clipped and many-sided pairs, each at its place.
TEST(Exchange, EveryEntryIsThatOfItsPair) {
  const scenes::PatchMesh mesh = sample_mesh("office");
  const std::vector<Facet> facets = facets_of(mesh);
  const ExchangeAreas exchange = compute_exchange(mesh, Visibility());
  constexpr double kRounding = 1.2e-7;
  for (int i = 0; i < mesh.size(); i += 3) {
    for (int j = i + 1; j < mesh.size(); j += 5) {
      const Facet &a = facets[static_cast<std::size_t>(i)],
                  &b = facets[static_cast<std::size_t>(j)];
      const double expected = exchange_area(a, b);
      EXPECT_NEAR(static_cast<double>(exchange.unscaled.at(i, j)), expected,
                  kRounding * expected + 2 * exchange_error_m2(a, b))
          << i << " " << j;
      EXPECT_EQ(exchange.unscaled.at(i, j), exchange.unscaled.at(j, i));
    }
  }
}

}  // namespace
}  // namespace solver
