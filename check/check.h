#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "check/claims.h"
#include "check/result_file.h"
#include "check/script.h"

namespace rung::check {

enum class Outcome : std::uint8_t {
  Confirmed,   // the certificate proves it
  Rejected,    // it does not, or is about something else
  NotChecked,  // `reason` says why
  ByRun,       // a witness or a violation: the simulator has replayed it
  Open,        // it was not claimed to hold
};

std::string_view to_string(Outcome outcome);

struct Checked {
  std::string name;
  Outcome outcome = Outcome::NotChecked;
  std::string reason;
};

/// All that a result claims, made into questions for a solver.
///
/// What is to be proved is read from the source alone. Of the result its name
/// is looked up, its text compared, and its lemmas are what is tried as a
/// proof.
class CertificateCheck {
 public:
  /// `wanted`: the names of properties; empty for all.
  CertificateCheck(Claims claims, const ClaimedResult& claimed,
                   const std::vector<std::string>& wanted);
  CertificateCheck(const CertificateCheck&) = delete;
  CertificateCheck& operator=(const CertificateCheck&) = delete;

  /// One for each proof; properties with the same lemmas share theirs.
  const std::vector<std::string>& scripts() const { return scripts_; }

  /// How many answers these will have.
  std::size_t questions() const;

  /// `answers` to all scripts, in order; `error`, if they are not all there.
  std::vector<Checked> conclude(const std::vector<std::string>& answers,
                                const std::string& error) const;

 private:
  struct Group {
    std::vector<std::string> lemmas;      // as the certificate has them
    std::vector<std::string> conditions;  // the same
    Proof proof;                          // of the properties alone
    std::vector<Claim> helpers;           // conditions that may be needed
    std::vector<std::size_t> properties;  // by condition: index of checked_
    bool is_shared = true;                // by properties with these lemmas
    bool is_partial = false;              // conditions that are not understood
    std::vector<Script> scripts;  // alone; with helpers; with equal memories
  };

  void add(const ClaimedProperty& property, std::size_t index);
  void add_to_group(const ClaimedProperty& property, std::size_t index,
                    Value condition);
  void add_ways(const ClaimedProperty& property, std::size_t index,
                Value condition);
  std::string read_certificate(const ClaimedProperty& property, Group& group,
                               bool& cut_off);
  void write_scripts(Group& group);
  static void judge(const Group& group, const Script& script,
                    const std::vector<std::string>& answers,
                    std::vector<Checked>& checked);

  std::unique_ptr<Model> model_;
  std::vector<Goal> goals_;
  std::vector<Claim> equal_;  // memories that lemmas may know by another name
  std::vector<Checked> checked_;
  std::vector<Group> groups_;
  std::vector<std::string> scripts_;
};

}  // namespace rung::check
