# SPDX-License-Identifier: Apache-2.0
# capture.zsh FOLDER LINE: what zsh offers at the end of LINE, a word each line, with the completion
# functions of FOLDER. A shell in a new terminal completes; compadd prints its arguments.
zmodload zsh/zpty || exit 1
zpty shell zsh -f -i
zpty -w shell "PROMPT=; RPROMPT=; unsetopt zle_bracketed_paste 2>/dev/null; fpath=(${(q)1} \$fpath)"
zpty -w shell 'autoload -Uz compinit && compinit -D -u'
zpty -w shell 'bindkey "^I" capture; zle -C capture .list-choices capture
compadd() {
  if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * || ${@[1,(i)(-|--)]} == -[OAD]* ]]; then
    builtin compadd "$@"
    return $?
  fi
  local -a hits
  builtin compadd -A hits "$@"
  (( ${#hits} )) && print -rl -- "<hit>"${^hits}"</hit>"
  builtin compadd "$@"
}
capture() { print -r -- "<begin>"; _main_complete; print -r -- "<end>"; }'
zpty -w shell 'zstyle ":completion:*" insert-tab false; print -r -- "<re""ady>"'
local text
while zpty -r shell text; do [[ $text == *'<ready>'* ]] && break; done
zpty -w -n shell "$2"$'\t'
local begun=
while zpty -r shell text; do
  text=${text%%[[:space:]]#}
  [[ $text == *'<begin>'* ]] && begun=1
  while [[ $begun && $text == *'<hit>'*'</hit>'* ]]; do
    text=${text#*<hit>}
    print -r -- "${text%%</hit>*}"
    text=${text#*</hit>}
  done
  [[ $begun && $text == *'<end>'* ]] && break
done
zpty -d shell
