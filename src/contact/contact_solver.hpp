#pragma once

/// @file
/// The seam between what asks for a contact and what solves it. A new solver derives from this
/// class in a folder of its own and gets a line in prediction/contact_solvers.cpp; nothing else
/// needs to know it.

#include "contact/contact_problem.hpp"
#include "mems_stiction/contact/contact_solution.hpp"

namespace mems_stiction {

/// Finds where two surfaces come to rest, and what it takes to part them. Keeps its working memory
/// between calls; one object serves one thread at a time.
class ContactSolver {
 public:
  ContactSolver() = default;
  virtual ~ContactSolver() = default;
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;

  /// Fills the whole solution, whose memory is used again.
  /// @throw SurfaceError if it cannot work with these surfaces.
  virtual void solve(const ContactProblem& problem, ContactSolution& solution) = 0;
};

}  // namespace mems_stiction
