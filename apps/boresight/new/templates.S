/* The files that `boresight new` writes, as bytes. Each ends with a zero byte. */
        .section .rodata
        .global boresight_template_mechanism
        .global boresight_template_montecarlo
boresight_template_mechanism:
        .incbin TEMPLATE_MECHANISM
        .byte 0
boresight_template_montecarlo:
        .incbin TEMPLATE_MONTECARLO
        .byte 0
        .section .note.GNU-stack,"",%progbits
