// Writes the project's own picture of high dynamic range, under the blue sky of [Granier2004] 7.2:
//   hdr_picture sky.exr
#include "tests/support/hdr_picture.h"

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: hdr_picture OUT.exr\n");
    return 2;
  }
  support::write_exr(support::hdr_picture(spectra::bilinear_set("granier-iso"), {0.4, 0.9, 1.0}),
                     argv[1]);
}
