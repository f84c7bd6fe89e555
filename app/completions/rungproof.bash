# bash completion of rungproof; tests/app/manual_test.cpp compares it with the
# options that the program has.

_rungproof() {
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  local commands="check lint prove equiv bound lock lower export run render baseline config rule upload monitor lsp"
  local common="--help --version --format --scan --semantics --rollover --stable-inputs --pou --dialect
    --language --props --timeout --engine --jobs --fail-on --color --quiet
    --verbose --property --self-check --recheck --certificates --map
    --explain --cache --config --no-config --pack --rule --baseline"
  local command= word
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    [[ " $commands " == *" $word "* ]] && { command=$word; break; }
  done
  COMPREPLY=()
  case $previous in
    --format)
      local formats="text json jsonl sarif junit github gitlab html"
      [[ $command == render ]] && formats="text svg"
      COMPREPLY=($(compgen -W "$formats" -- "$current")) ;;
    --dialect) COMPREPLY=($(compgen -W "yun sim" -- "$current")) ;;
    --semantics)
      COMPREPLY=($(compgen -W "yun sim iec openplc beremiz-py2 esbmc 
        ldmicro0.1 ldmicro0.2 logix s7 melsec plclib plclib14" -- "$current")) ;;
    --language)
      COMPREPLY=($(compgen -W "script postfix il-iec st plcopen ldmicro
        ascii il-mitsubishi stl l5x rungs plclib" -- "$current")) ;;
    --engine)
      COMPREPLY=($(compgen -W "bmc induction pdr simulation" -- "$current")) ;;
    --fail-on)
      COMPREPLY=($(compgen -W "note warning error" -- "$current")) ;;
    --pack) COMPREPLY=($(compgen -W "default safety pedantic" -- "$current")) ;;
    --color) COMPREPLY=($(compgen -W "auto always never" -- "$current")) ;;
    --replay-on) COMPREPLY=($(compgen -W "uno yun arm" -- "$current")) ;;
    --self-check) COMPREPLY=($(compgen -W "on off" -- "$current")) ;;
    --recheck) COMPREPLY=($(compgen -W "cvc5 z3" -- "$current")) ;;
    --to)
      local targets="postfix il-iec st script il-mitsubishi ascii plcopen ldmicro plclib"
      [[ $command == export ]] && targets="aiger btor2 chc"
      COMPREPLY=($(compgen -W "$targets" -- "$current")) ;;
    --certificates|--cache|--traces) COMPREPLY=($(compgen -d -- "$current")) ;;
    --scan|--timeout|--rule|--jobs|--property|--map|--scans|--dt|--rung|--delay|--git|--tcp|--wait) ;;
    --baud)
      local speeds="9600 19200 38400 57600 115200 230400 500000 1000000"
      COMPREPLY=($(compgen -W "$speeds" -- "$current")) ;;
    *)
      if [[ $previous != --props && $current == -* ]]; then
        case $command in
          lint) common+=" --fix --diff" ;;
          prove) common+=" --sweep --replay-on --traces" ;;
          baseline) common+=" --accept-new" ;;
          equiv) common+=" --rung --delay --settled --git" ;;
          check) common+=" --locked" ;;
          lock) common+=" --output --update" ;;
          lower) common+=" --to --output --binary --header --report" ;;
          export) common+=" --to --output" ;;
          run) common+=" --stimulus --scans --dt --out" ;;
          render) common+=" --ascii" ;;
          upload) common+=" --port --tcp --baud --wait --clear-outputs" ;;
          lsp) common+=" --stdio" ;;
          monitor) common+=" --port --tcp --baud --wait --scans" ;;
        esac
        COMPREPLY=($(compgen -W "$common" -- "$current"))
      elif [[ -z $command && $previous != --props ]]; then
        COMPREPLY=($(compgen -W "$commands" -- "$current"))
      else
        COMPREPLY=($(compgen -f -- "$current"))
      fi ;;
  esac
}
complete -o filenames -F _rungproof rungproof
