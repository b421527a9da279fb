#include "paints/ranking.h"
