#include "imaging/study.h"
