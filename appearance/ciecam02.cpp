#include "appearance/ciecam02.h"
