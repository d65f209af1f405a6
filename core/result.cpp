#include "core/result.h"

namespace tidemark {

int exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::internal:
      return 1;
    case ErrorKind::usage:
      return 2;
    case ErrorKind::input:
      return 3;
    case ErrorKind::capability:
      return 4;
    case ErrorKind::write:
      return 5;
    case ErrorKind::cancelled:
      return 130;
  }
  return 1;
}

}  // namespace tidemark
